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

#include "mesh_scene.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "mesh_distributed.h"

#include <cmath>

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using Membrane_NS::Face;
using Membrane_NS::FaceTessellation;
using Membrane_NS::LimitPoint;
using Membrane_NS::Topology;

/* ---------------------------------------------------------------------- */

MeshScene::MeshScene(LAMMPS *lmp, const DistributedMesh &mesh, int groupbit, bool in_one_piece) :
    Pointers(lmp), mesh(mesh), control(mesh.triangle_mesh())
{
  place_components(in_one_piece);
  deal_faces(groupbit);
}

const std::array<bool, 3> &MeshScene::cut_along(int f) const
{
  return cuts[mesh.topology().component(mesh.topology().face(f)[0])];
}

// closed components near the box, or cut at it, as everything that continues through it

void MeshScene::place_components(bool in_one_piece)
{
  const Topology &topology = mesh.topology();
  cuts = continuing_directions(topology, control);
  if (!control.is_periodic()) return;

  std::vector<Vector3d> centre(topology.num_components(), Vector3d::Zero());
  for (int v = 0; v < topology.num_vertices(); ++v) {
    const int c = topology.component(v);
    centre[c] += control.points[v] / topology.num_vertices(c);
  }
  const Eigen::Matrix3d inverse = control.lattice.inverse();
  for (int c = 0; c < topology.num_components(); ++c) {
    const Vector3d fraction = inverse * (centre[c] - Vector3d(domain->boxlo));
    centre[c].setZero();
    for (int k = 0; k < 3; ++k) {
      if (!control.periodic[k] || cuts[c][k]) continue;
      if (in_one_piece)
        centre[c] -= std::floor(fraction[k]) * control.lattice.col(k);
      else
        cuts[c][k] = true;
    }
  }
  for (int v = 0; v < topology.num_vertices(); ++v)
    control.points[v] += centre[topology.component(v)];
}

void MeshScene::deal_faces(int groupbit)
{
  const Topology &topology = mesh.topology();
  std::vector<int> mine(topology.num_vertices(), 0);
  types.resize(mine.size());
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = mesh.vertex(atom->tag[i]);
    if (v >= 0 && (atom->mask[i] & groupbit)) mine[v] = atom->type[i];
  }
  MPI_Allreduce(mine.data(), types.data(), mine.size(), MPI_INT, MPI_MAX, world);

  // every rank has all of the mesh: they take turns

  int next = 0;
  for (int f = 0; f < topology.num_faces(); ++f) {
    const Face &face = topology.face(f);
    if (types[face[0]] && types[face[1]] && types[face[2]] && next++ % comm->nprocs == comm->me)
      my_faces.push_back(f);
  }
}

void MeshScene::evaluate(int f, FaceTessellation &tessellation, std::vector<LimitPoint> &points)
{
  stencil_points(mesh.topology(), control, f, stencil);
  tessellation.evaluate(mesh.topology().valences(f), stencil, points);
}

/* ---------------------------------------------------------------------- */

bool MeshScene::statistics(const std::function<double(const LimitPoint &)> &value, double &mean,
                           double &deviation)
{
  FaceTessellation coarse(2);
  std::vector<LimitPoint> points;
  double mine[3] = {0.0, 0.0, 0.0}, all[3];    // area, and integrals of the value and its square
  for (int f : my_faces) {
    evaluate(f, coarse, points);
    for (const Face &t : coarse.triangles()) {
      const LimitPoint &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
      const double area = 0.5 * (b.position - a.position).cross(c.position - a.position).norm();
      if (!std::isfinite(area + value(a) + value(b) + value(c))) continue;
      mine[0] += area;
      for (const LimitPoint *p : {&a, &b, &c}) {
        mine[1] += area / 3.0 * value(*p);
        mine[2] += area / 3.0 * value(*p) * value(*p);
      }
    }
  }
  MPI_Allreduce(mine, all, 3, MPI_DOUBLE, MPI_SUM, world);
  if (all[0] == 0.0) return false;
  mean = all[1] / all[0];
  deviation = std::sqrt(MAX(0.0, all[2] / all[0] - mean * mean));
  return true;
}
