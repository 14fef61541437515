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

#include "hd_modes.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hd_base.h"
#include "fmt/format.h"
#include "force.h"
#include "group.h"
#include "hd_stiffness_probe.h"
#include "math_const.h"
#include "membrane_mass_kinds.h"
#include "membrane_random.h"
#include "membrane_tessellation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace LAMMPS_NS;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using MathConst::MY_2PI;
using Membrane_NS::Eigenpairs;
using Membrane_NS::NormalMotion;
using Membrane_NS::TriangleMesh;
using Membrane_NS::VertexField;

static constexpr int MOST_PASSES = 60;

// more vectors than are asked for, so that the last of these do not wait for the next
static constexpr int SPARE = 5;

// an eigenvalue below this part of the largest one is nothing that differences of forces can tell from 0
static constexpr double NOTHING = 1.0e-6;

// the start vectors are always the same ones
static constexpr uint64_t SEED = 20250204;

/* ---------------------------------------------------------------------- */

HDModes::HDModes(LAMMPS *lmp) : Command(lmp), count(0), tolerance(1.0e-4), rigid(false) {}

/* ---------------------------------------------------------------------- */

void HDModes::command(int narg, char **arg)
{
  if (!domain->box_exist)
    error->all(FLERR, "hd_modes needs control points: use it after create_membrane or read_data");
  if (narg < 5) utils::missing_cmd_args(FLERR, "hd_modes", error);
  const int igroup = group->find(arg[0]);
  if (igroup < 0) error->all(FLERR, "Could not find hd_modes group ID {}", arg[0]);
  HDMass mass(lmp, igroup, "hd_modes");
  parse(narg, arg, mass, group->bitmask[igroup]);

  if (mass.settings.kind == Membrane_NS::MassKind::SAMPLING)
    error->all(FLERR, "hd_modes: mass sampling is stiffness in place of mass: choose another by keyword mass");

  StiffnessProbe::place_atoms(lmp);
  FixHDBase::atoms_renumbered(lmp);
  mass.init(true);
  if (mass.count() == 0) error->all(FLERR, "hd_modes: group {} has no control points", arg[0]);
  StiffnessProbe probe(lmp, mass, StiffnessProbe::Forces::ALL);
  if (!probe.has_forces()) error->all(FLERR, "hd_modes needs forces: use pair_style helfrich");
  probe.evaluate(true);

  // the membrane by itself

  const auto &topology = mass.mesh().topology();
  const int component = component_of(mass);
  const TriangleMesh all = mass.mesh().triangle_mesh();
  TriangleMesh mesh = all;
  mesh.points.clear();
  mesh.faces.clear();
  std::vector<int> vertices, number(all.points.size(), -1);
  for (int v = 0; v < topology.num_vertices(); ++v)
    if (topology.component(v) == component) {
      number[v] = static_cast<int>(vertices.size());
      vertices.push_back(v);
      mesh.points.push_back(all.points[v]);
    }
  for (const auto &face : all.faces)
    if (number[face[0]] >= 0) mesh.faces.push_back({number[face[0]], number[face[1]], number[face[2]]});
  NormalMotion motion(mesh, continuing_directions(topology, all)[component]);
  if (count > motion.size() / 4)
    error->all(FLERR, "hd_modes lowest {}: a membrane of {} control points has no more than {} modes that are shapes "
                      "rather than its mesh", count, motion.size(), motion.size() / 4);

  const Eigenpairs modes = solve(mass, probe, motion, vertices);
  probe.restore();
  probe.evaluate(true);
  mass.report_missed_tolerance();
  if (!modes.values.allFinite())
    error->all(FLERR, "hd_modes: forces are not finite numbers; is the state sensible?");
  if (!(modes.values.cwiseAbs().maxCoeff() > 0.0))
    error->all(FLERR, "hd_modes: nothing resists displacements of the membrane: are the coefficients of pair_style "
                      "helfrich zero?");
  write(mass, motion, modes, vertices, 1.0 / force->ftm2v);
}

/* ---------------------------------------------------------------------- */

void HDModes::parse(int narg, char **arg, HDMass &mass, int groupbit)
{
  if (std::string(arg[1]) != "lowest")
    error->all(FLERR, "hd_modes {}: after the group comes: lowest N file NAME", arg[1]);
  count = utils::inumeric(FLERR, arg[2], false, lmp);
  if (count < 1) error->all(FLERR, "hd_modes lowest {} must be 1 or more", arg[2]);
  if (std::string(arg[3]) != "file")
    error->all(FLERR, "hd_modes {}: after lowest N comes: file NAME", arg[3]);
  file = arg[4];

  // the matrix of the integrator of these atoms, unless the user chooses one

  const FixHDBase *integrator = FixHDBase::of_group(lmp, groupbit, "hd_modes");
  if (integrator) {
    mass.settings = integrator->mass_settings();
    mass.settings.modes.reset();
    if (integrator->drag_coefficient() > 0.0) mass.set_drag(integrator->drag_coefficient());
  }
  int iarg = 5;
  while (iarg < narg) {
    if (const int used = mass.parse(iarg, narg, arg)) {
      iarg += used;
      continue;
    }
    const std::string key = arg[iarg];
    if (key != "residual" && key != "rigid")
      error->all(FLERR, "Unknown hd_modes keyword {}; known are: residual, rigid, mass, solver, tol", key);
    if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "hd_modes " + key, error);
    if (key == "rigid")
      rigid = utils::logical(FLERR, arg[iarg + 1], false, lmp);
    else
      tolerance = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    if (!(tolerance >= 1.0e-7 && tolerance <= 0.1))
      error->all(FLERR, "hd_modes residual {} must be between 1e-7 and 0.1", arg[iarg + 1]);
    iarg += 2;
  }
}

int HDModes::component_of(HDMass &mass) const
{
  const auto &topology = mass.mesh().topology();
  std::vector<int> mine(topology.num_components(), 0), all(mine.size());
  for (int i = 0; i < mass.part().owned; ++i) mine[topology.component(mass.part().vertices[i])] = 1;
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(all.size()), MPI_INT, MPI_MAX, world);
  const auto found = std::count(all.begin(), all.end(), 1);
  if (found != 1)
    error->all(FLERR, "hd_modes: the group has {} membranes: find the modes of one at a time", found);
  return static_cast<int>(std::find(all.begin(), all.end(), 1) - all.begin());
}

/* ----------------------------------------------------------------------
   phi is the same on all ranks, and so is all that is derived from it; K and M act on the part of each
------------------------------------------------------------------------- */

Eigenpairs HDModes::solve(HDMass &mass, StiffnessProbe &probe, NormalMotion &motion, const std::vector<int> &vertices) const
{
  MeshPart &part = mass.part();
  const auto n = static_cast<int>(vertices.size());
  VertexField v(part.size()), product(part.size()), whole(mass.mesh().topology().num_vertices());
  VertexField here(n), moved(whole.size());
  auto by_columns = [&](const MatrixXd &phi, auto &&multiply) {
    MatrixXd result(phi.rows(), phi.cols());
    for (Eigen::Index k = 0; k < phi.cols(); ++k) {
      const VertexField dq = motion.displacement(phi.col(k));
      for (int i = 0; i < n; ++i) moved[vertices[i]] = dq[i];
      for (int i = 0; i < part.owned; ++i) v[i] = moved[part.vertices[i]];
      multiply();
      part.gather(product, whole);
      for (int i = 0; i < n; ++i) here[i] = whole[vertices[i]];
      result.col(k) = motion.force(here);
    }
    return result;
  };
  auto stiffness = [&](const MatrixXd &phi) { return by_columns(phi, [&] { probe.multiply(v, product); }); };
  auto inertia = [&](const MatrixXd &phi) {
    return by_columns(phi, [&] { mass.matrix().multiply(v, product); });
  };
  auto soften = [&](const MatrixXd &phi) { return motion.soften(phi); };

  MatrixXd noise(n, count + SPARE);
  for (int i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < noise.cols(); ++k)
      noise(i, k) = Membrane_NS::CounterRandom(SEED, k).normals(i)[0];
  const MatrixXd kept_out = rigid ? MatrixXd(n, 0) : motion.rigid();
  return Membrane_NS::lowest_eigenpairs(count, motion.soften(noise), kept_out, stiffness, inertia, soften, tolerance,
                                        MOST_PASSES);
}

/* ----------------------------------------------------------------------
   modes such that an amplitude is the root mean square displacement of the surface: x^T M x = 1 before
------------------------------------------------------------------------- */

void HDModes::write(HDMass &mass, NormalMotion &motion, const Eigenpairs &modes, const std::vector<int> &vertices,
                    double stiffness_unit) const
{
  const bool overdamped = mass.drag_coefficient() > 0.0;
  const auto n = static_cast<int>(modes.values.size());
  std::vector<VertexField> shapes;
  std::string table = fmt::format("# mode  {}  stiffness  residual\n", overdamped ? "relaxation time" : "period");
  int soft = 0, unstable = 0, open = 0;
  for (int k = 0; k < n; ++k) {
    VectorXd phi = modes.vectors.col(k);
    const double size = std::sqrt(phi.cwiseAbs2().dot(motion.areas()) / motion.areas().sum());
    Eigen::Index furthest;
    phi.cwiseAbs().maxCoeff(&furthest);
    phi /= std::copysign(size, phi[furthest]);
    shapes.push_back(motion.displacement(phi));
    const double value = modes.values[k], least = NOTHING * modes.values[n - 1];
    std::string time = "none";
    if (value > least) time = fmt::format("{:.6g}", overdamped ? 1.0 / value : MY_2PI / std::sqrt(value));
    soft += std::fabs(value) <= std::fabs(least);
    unstable += value < -std::fabs(least);
    open += !(modes.residuals[k] <= tolerance);
    table += fmt::format("# {:4}  {:>12}  {:12.6g}  {:.1g}\n", k + 1, time, value * stiffness_unit / (size * size),
                         modes.residuals[k]);
  }
  if (comm->me == 0)
    utils::logmesg(lmp, "Lowest modes of {} control points, mass {}, by {} products with the stiffness:\n{}", vertices.size(),
                   Membrane_NS::mass_kind_name(mass.settings.kind), modes.products, table);
  if (unstable && comm->me == 0)
    error->warning(FLERR, "hd_modes: {} of the modes grow by themselves: this is no minimum of the energy, minimize before",
                   unstable);
  if (soft && comm->me == 0)
    error->warning(FLERR, "hd_modes: nothing restores {} of the modes; {}", soft,
                   rigid ? "rigid no leaves out translations and turns" : "give area or volume, or what else holds the shape");
  if (open && comm->me == 0)
    error->warning(FLERR, "hd_modes: {} of the modes have residuals above {} after {} passes", open, tolerance, MOST_PASSES);

  int failed = 0;
  if (comm->me == 0) {
    FILE *fp = fopen(file.c_str(), "w");
    failed = fp == nullptr;
    if (fp) {
      fmt::print(fp, "# modes of a membrane, for \"modes file\" of fix hd: atom ID, then x y z of each mode\n{}", table);
      for (size_t i = 0; i < vertices.size(); ++i) {
        fmt::print(fp, "{}", mass.mesh().tag(vertices[i]));
        for (const VertexField &shape : shapes)
          fmt::print(fp, " {:.9g} {:.9g} {:.9g}", shape[i].c[0], shape[i].c[1], shape[i].c[2]);
        fmt::print(fp, "\n");
      }
      failed = ferror(fp) != 0;
      failed |= fclose(fp) != 0;
    }
  }
  MPI_Bcast(&failed, 1, MPI_INT, 0, world);
  if (failed) error->all(FLERR, "hd_modes: cannot write file {}", file);
}
