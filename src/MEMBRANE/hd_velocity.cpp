/* -----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing author: MEMBRANE developers
------------------------------------------------------------------------- */

#include "hd_velocity.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hd_base.h"
#include "force.h"
#include "group.h"
#include "hd_stiffness_probe.h"

#include <Eigen/Dense>

#include <cmath>

using namespace LAMMPS_NS;
using Membrane_NS::VertexField;

// the thermostats draw from the same seeds at time steps, of which this is none
static constexpr uint64_t NO_TIMESTEP = (uint64_t(1) << 48) - 1;

/* ---------------------------------------------------------------------- */

HDVelocity::HDVelocity(LAMMPS *lmp) :
    Command(lmp), temperature(0.0), seed(0), momentum(true), rotation(false), scale(false)
{
}

/* ---------------------------------------------------------------------- */

void HDVelocity::command(int narg, char **arg)
{
  if (!domain->box_exist)
    error->all(FLERR,
               "hd_velocity needs control points: use it after create_membrane or read_data");
  if (narg < 3) utils::missing_cmd_args(FLERR, "hd_velocity", error);
  const int igroup = group->find(arg[0]);
  if (igroup < 0) error->all(FLERR, "Could not find hd_velocity group ID {}", arg[0]);
  HDMass mass(lmp, igroup, "hd_velocity");
  parse(narg, arg, mass, group->bitmask[igroup]);

  // this mass is made of what the pair style resists, which has to know its membranes for that, also before the first run
  if (mass.settings.kind == Membrane_NS::MassKind::SAMPLING) StiffnessProbe::place_atoms(lmp);

  mass.init(true);
  if (mass.count() == 0) error->all(FLERR, "hd_velocity: group {} has no control points", arg[0]);
  mass.refresh();

  // the mass of LAMMPS' units times velocity squared is energy over mvv2e

  const double kT = force->boltz * temperature / force->mvv2e;
  VertexField v(mass.part().size());
  mass.matrix().sample(kT, seed, NO_TIMESTEP, v);
  const double dof = mass.modal() ? mass.modal()->count() : 3.0 * mass.count() - remove_rigid_motion(mass, v);

  if (scale && kT > 0.0) {
    const auto t = mass.matrix().kinetic(v);
    const double twice = t[0] + t[1] + t[2];
    if (!(dof > 0.0) || !(twice > 0.0))
      error->all(FLERR, "hd_velocity: group {} has no degrees of freedom left", arg[0]);
    for (auto &vertex : v)
      for (int k = 0; k < 3; ++k) vertex.c[k] *= std::sqrt(dof * kT / twice);
  }
  mass.part().store(v, atom->v);
  mass.report_missed_tolerance();
}

/* ---------------------------------------------------------------------- */

void HDVelocity::parse(int narg, char **arg, HDMass &mass, int groupbit)
{
  temperature = utils::numeric(FLERR, arg[1], false, lmp);
  seed = utils::bnumeric(FLERR, arg[2], false, lmp);
  if (!(temperature >= 0.0) || !std::isfinite(temperature))
    error->all(FLERR, "hd_velocity temperature {} must not be negative", arg[1]);
  if (seed <= 0) error->all(FLERR, "hd_velocity seed {} must be positive", arg[2]);

  // the mass matrix of the integrator of these atoms, unless the user chooses one

  if (const FixHDBase *integrator = FixHDBase::of_group(lmp, groupbit, "hd_velocity"))
    mass.settings = integrator->mass_settings();

  int iarg = 3;
  while (iarg < narg) {
    if (const int used = mass.parse(iarg, narg, arg)) {
      iarg += used;
      continue;
    }
    const std::string key = arg[iarg];
    if (key != "mom" && key != "rot" && key != "scale")
      error->all(FLERR,
                 "Unknown hd_velocity keyword {}; known are: mass, solver, tol, mom, rot, scale",
                 key);
    if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "hd_velocity " + key, error);
    (key == "mom"       ? momentum
         : key == "rot" ? rotation
                        : scale) = utils::logical(FLERR, arg[iarg + 1], false, lmp);
    iarg += 2;
  }
}

/* ----------------------------------------------------------------------
   subtract the rigid motion whose momenta sum b_k M v are those of v, with b_k the three
   translations and three rotations; returns how many degrees of freedom that takes
------------------------------------------------------------------------- */

double HDVelocity::remove_rigid_motion(HDMass &mass, VertexField &v)
{
  MeshPart &part = mass.part();
  const DistributedMesh &mesh = mass.mesh();
  const auto &topology = mesh.topology();
  const int first = momentum ? 0 : 3, last = rotation ? 6 : 3, n = last - first;
  if (n == 0) return 0.0;

  // rotations about the middle of the control points, in one piece each

  double sums[4] = {0.0, 0.0, 0.0, 0.0};
  for (int i = 0; i < part.owned; ++i) {
    const int vertex = part.vertices[i];
    if (!mesh.is_closed(topology.component(vertex))) sums[3] += 1.0;
    for (int k = 0; k < 3; ++k) sums[k] += mesh.unwrapped()[3 * vertex + k];
  }
  part.sum(sums, 4);
  if (rotation && sums[3] > 0.0)
    error->all(FLERR,
               "hd_velocity rot yes: a membrane that continues through the periodic box cannot "
               "rotate; use rot no");
  const Eigen::Vector3d middle = Eigen::Vector3d(sums) / mass.count();

  std::vector<VertexField> motion(n, VertexField(v.size()));
  for (int i = 0; i < part.owned; ++i) {
    const Eigen::Vector3d r = Eigen::Vector3d(&mesh.unwrapped()[3 * part.vertices[i]]) - middle;
    for (int m = 0; m < n; ++m) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit((first + m) % 3);
      Eigen::Map<Eigen::Vector3d>(motion[m][i].c) = first + m < 3 ? axis : axis.cross(r);
    }
  }

  Eigen::Matrix<double, 6, 7> inertia = Eigen::Matrix<double, 6, 7>::Zero();
  VertexField p(v.size());
  for (int m = 0; m < n; ++m) {
    mass.matrix().multiply(motion[m], p);
    for (int i = 0; i < part.owned; ++i) {
      const Eigen::Map<const Eigen::Vector3d> pi(p[i].c);
      for (int l = 0; l < n; ++l)
        inertia(l, m) += pi.dot(Eigen::Map<const Eigen::Vector3d>(motion[l][i].c));
      inertia(m, 6) += pi.dot(Eigen::Map<const Eigen::Vector3d>(v[i].c));
    }
  }
  part.sum(inertia.data(), inertia.size());

  const Eigen::VectorXd rate = inertia.topLeftCorner(n, n).ldlt().solve(inertia.col(6).head(n));
  for (int i = 0; i < part.owned; ++i)
    for (int m = 0; m < n; ++m)
      for (int k = 0; k < 3; ++k) v[i].c[k] -= rate[m] * motion[m][i].c[k];
  return n;
}
