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

#include "srd_surface.h"

#include "atom.h"
#include "comm.h"
#include "membrane_limit_basis.h"
#include "membrane_tessellation.h"
#include "mesh_box.h"
#include "mesh_distributed.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Membrane_NS::SurfaceCorners;
using Membrane_NS::SurfaceVertex;
using Membrane_NS::Topology;
using Membrane_NS::TriangleMesh;

/* ---------------------------------------------------------------------- */

SRDSurface::SRDSurface(LAMMPS *lmp, int groupbit, int level, std::string user) :
    Pointers(lmp), groupbit(groupbit), level(level), user(std::move(user)), num_masses(0),
    mean_edge(0.0)
{
}

void SRDSurface::setup(const DistributedMesh &mesh)
{
  const Topology &topology = mesh.topology();
  const TriangleMesh control = mesh.triangle_mesh();
  num_masses = topology.num_vertices();
  find_components(mesh);
  find_offsets(mesh, control);
  cut_faces(topology, find_seams(topology, control));
  make_triangles(topology, control);
}

void SRDSurface::find_components(const DistributedMesh &mesh)
{
  const auto &topology = mesh.topology();
  const int n = topology.num_components();
  std::vector<int> here(n, 0), any(n);
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = mesh.vertex(atom->tag[i]);
    if (v >= 0 && atom->mask[i] & groupbit) here[topology.component(v)] = 1;
  }
  MPI_Allreduce(here.data(), any.data(), n, MPI_INT, MPI_MAX, world);
  group_components.clear();
  for (int c = 0; c < n; ++c)
    if (any[c]) group_components.push_back(c);
}

/* ----------------------------------------------------------------------
   which images of atoms belong together does not change while LAMMPS counts image flags
------------------------------------------------------------------------- */

static std::array<int, 3> in_box_vectors(const Matrix3d &to_fraction, const Vector3d &d)
{
  const Vector3d s = to_fraction * d;
  return {(int) std::lround(s[0]), (int) std::lround(s[1]), (int) std::lround(s[2])};
}

void SRDSurface::find_offsets(const DistributedMesh &mesh, const TriangleMesh &control)
{
  const int n = num_masses;
  const Matrix3d to_fraction = box_vectors(*domain).inverse();
  std::vector<int> here(3 * n, 0), sum(3 * n);
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = mesh.vertex(atom->tag[i]);
    if (v < 0) continue;
    Vector3d x;
    domain->unmap(atom->x[i], atom->image[i], x.data());
    const auto d = in_box_vectors(to_fraction, control.points[v] - x);
    std::copy(d.begin(), d.end(), &here[3 * v]);
  }
  MPI_Allreduce(here.data(), sum.data(), 3 * n, MPI_INT, MPI_SUM, world);
  offset.resize(n);
  for (int v = 0; v < n; ++v) std::copy_n(&sum[3 * v], 3, offset[v].begin());
}

// none if no edge passes through the boundary

SurfaceCorners::Seams SRDSurface::find_seams(const Topology &topology, const TriangleMesh &control)
{
  const Matrix3d to_fraction = box_vectors(*domain).inverse();
  ring_seam.assign(num_masses, {0, 0, 0});
  SurfaceCorners::Seams seams(num_masses);
  bool passes = false;
  for (int v = 0; v < num_masses; ++v)
    for (int u : topology.ring(v)) {
      const auto d =
          in_box_vectors(to_fraction, control.points[v] + control.edge(v, u) - control.points[u]);
      seams[v].push_back(d);
      for (int k = 0; k < 3; ++k) {
        ring_seam[v][k] += d[k];
        passes = passes || d[k] != 0;
      }
    }
  if (!passes) seams.clear();
  return seams;
}

void SRDSurface::cut_faces(const Topology &topology, SurfaceCorners::Seams seams)
{
  if (level == 0 || (finer && finer_faces == topology.faces() && finer_seams == seams)) return;
  finer.reset();
  if (comm->me == 0)
    utils::logmesg(lmp, "{}: cutting {} faces into {} triangles each\n", user, topology.num_faces(),
                   1 << (2 * level));
  finer = std::make_unique<SurfaceCorners>(topology, 1 << level, seams);
  finer_faces = topology.faces();
  finer_seams = std::move(seams);
}

/* ----------------------------------------------------------------------
   The triangles, and the box vectors between the places of their corners. Each face has its corners
   together, as its control points are, while corners and masses each have one place.
------------------------------------------------------------------------- */

void SRDSurface::make_triangles(const Topology &topology, const TriangleMesh &control)
{
  const int n = topology.num_vertices();
  const Matrix3d to_fraction = box_vectors(*domain).inverse();
  triangles = {};
  face_component.clear();
  group_faces.clear();

  // a mass has its place with its control point, as in SurfaceMotion::load_positions()

  std::vector<Vector3d> place(num_vertices());
  std::vector<char> placed(num_vertices(), 0);
  for (int v = 0; v < n; ++v) {
    const double spokes = 1.0 - Membrane_NS::limit_mask_centre(topology.valence(v));
    place[v] = control.points[v];
    for (int u : topology.ring(v)) place[v] += spokes / topology.valence(v) * control.edge(v, u);
    placed[v] = 1;
  }

  std::vector<char> in_group(topology.num_components(), 0);
  for (int c : group_components) in_group[c] = 1;
  Membrane_NS::FaceTessellation cut(1 << level);
  Membrane_NS::StencilPoints stencil;
  std::vector<Membrane_NS::LimitPoint> points;
  double length = 0.0;
  int num_edges = 0;
  for (int f = 0; f < topology.num_faces(); ++f) {
    const auto &face = topology.face(f);
    const int c = topology.component(face[0]);
    if (!in_group[c]) continue;
    group_faces.push_back(f);
    for (int k = 0; k < 3; ++k) length += control.edge(face[k], face[(k + 1) % 3]).norm();
    num_edges += 3;
    Membrane_NS::stencil_points(topology, control, f, stencil);
    cut.evaluate(topology.valences(f), stencil, points);
    for (size_t t = 0; t < cut.triangles().size(); ++t) {
      const auto &corners = cut.triangles()[t];
      const auto &triangle = finer ? finer->triangles()[f * cut.triangles().size() + t]
                                   : topology.face(f);
      std::array<Vector3d, 3> images;
      for (int k = 0; k < 3; ++k) {
        const int corner = triangle[k];
        const Vector3d &here = points[corners[k]].position;
        if (!placed[corner]) place[corner] = here;
        placed[corner] = 1;
        images[k] = to_fraction * (here - place[corner]);
      }
      std::array<std::array<int, 3>, 3> seam;
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i)
          seam[k][i] = static_cast<int>(std::lround(images[k][i] - images[0][i]));
      triangles.faces.push_back(triangle);
      triangles.seams.push_back(seam);
      face_component.push_back(c);
    }
  }
  mean_edge = length / std::max(1, num_edges);
}

void SRDSurface::place_corners(const SurfaceCorners *corners,
                               std::vector<SurfaceVertex> &vertices) const
{
  if (!corners) return;
  const Matrix3d box = box_vectors(*domain);
  for (size_t v = corners->num_masses(); v < vertices.size(); ++v) {
    SurfaceVertex corner;
    corner.path = {box * corners->shift(v), Vector3d::Zero()};
    for (const auto &[a, g] : corners->masses_of(v)) {
      const SurfaceVertex &one = vertices[a];
      corner.path.origin += g * one.path.origin;
      corner.path.velocity += g * one.path.velocity;
      corner.acceleration += g * one.acceleration;
    }
    vertices[v] = corner;
  }
}

void SRDSurface::add_triangles(int mesh_face, std::vector<int> &list) const
{
  const auto at = std::lower_bound(group_faces.begin(), group_faces.end(), mesh_face);
  if (at == group_faces.end() || *at != mesh_face) return;
  const int count = 1 << (2 * level), first = static_cast<int>(at - group_faces.begin()) * count;
  for (int t = first; t < first + count; ++t) list.push_back(t);
}

double SRDSurface::memory_usage() const
{
  return sizeof(int) * (6.0 * offset.capacity() + group_faces.capacity()) +
      (finer ? finer->memory_usage() : 0.0) +
      triangles.faces.capacity() * (sizeof(Membrane_NS::Face) + 9 * sizeof(int));
}
