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

#include "mesh_gaps.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "mesh_box.h"
#include "mesh_distributed.h"
#include "modify.h"
#include "pair_hybrid.h"

#include <cmath>

using namespace LAMMPS_NS;

// === Edges of the mesh by type of their control points

struct EdgeLengths {
  std::vector<double> longest, sum, count;
};

static double edge_length(const Domain &domain, const std::vector<double> &x, int v, int w)
{
  double d[3];
  for (int k = 0; k < 3; ++k) d[k] = x[3 * w + k] - x[3 * v + k];
  nearest_image(domain, d);    // a membrane that continues through the box has edges across it
  return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

// a face is on the left of each of its edges: those that begin at v are all of v

static EdgeLengths edge_lengths(const Atom &atom, const Domain &domain, const DistributedMesh &mesh,
                                MPI_Comm world)
{
  const int n = atom.ntypes + 1;
  const std::vector<double> &x = mesh.unwrapped();
  EdgeLengths mine{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)}, all = mine;
  for (int i = 0; i < atom.nlocal; ++i) {
    const int v = mesh.vertex(atom.tag[i]), t = atom.type[i];
    if (v < 0) continue;
    for (int f : mesh.topology().faces_around(v)) {
      const auto &face = mesh.topology().face(f);
      int corner = 0;
      while (face[corner] != v) ++corner;
      const double length = edge_length(domain, x, v, face[(corner + 1) % 3]);
      mine.longest[t] = MAX(mine.longest[t], length);
      mine.sum[t] += length;
      mine.count[t] += 1.0;
    }
  }
  MPI_Allreduce(mine.longest.data(), all.longest.data(), n, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(mine.sum.data(), all.sum.data(), n, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(mine.count.data(), all.count.data(), n, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

/* ----------------------------------------------------------------------
   names of the styles between two types, of those that pair_style hybrid has
------------------------------------------------------------------------- */

std::string MeshGaps::pair_styles(int type, int other) const
{
  auto *hybrid = dynamic_cast<PairHybrid *>(force->pair);
  if (!hybrid) return "";
  std::string names;
  for (const auto &style : *force->pair_map) {
    std::string name = style.first;
    if (name == "helfrich" || utils::strmatch(name, "^zero")) continue;
    if (hybrid->check_ijtype(type, other, &name[0])) names += (names.empty() ? "" : " and ") + name;
  }
  return names;
}

/* ----------------------------------------------------------------------
   types that occur beside membranes; solvent of fix srd/mesh does not cross them whatever pairs do
------------------------------------------------------------------------- */

std::vector<int> MeshGaps::types_of_others(const DistributedMesh &mesh) const
{
  int solvent = 0;
  for (auto &fix : modify->get_fix_by_style("^srd/mesh")) solvent |= fix->groupbit;
  std::vector<int> mine(atom->ntypes + 1, 0), any(mine.size());
  for (int i = 0; i < atom->nlocal; ++i)
    if (!(atom->mask[i] & solvent) && mesh.vertex(atom->tag[i]) < 0) mine[atom->type[i]] = 1;
  MPI_Allreduce(mine.data(), any.data(), mine.size(), MPI_INT, MPI_MAX, world);
  return any;
}

/* ---------------------------------------------------------------------- */

void MeshGaps::warn(const DistributedMesh &mesh)
{
  if (!dynamic_cast<PairHybrid *>(force->pair)) return;
  const EdgeLengths edges = edge_lengths(*atom, *domain, mesh, world);
  const std::vector<int> others = types_of_others(mesh);
  for (int t = 1; t <= atom->ntypes; ++t)
    for (int other = 1; other <= atom->ntypes; ++other) {
      const double range = std::sqrt(force->pair->cutsq[t][other]);
      if (!others[other] || !(range > 0.0) || range >= edges.longest[t] || warned.count({t, other}))
        continue;
      const std::string styles = pair_styles(t, other);
      if (styles.empty()) continue;
      warned.insert({t, other});
      if (comm->me == 0)
        error->warning(FLERR,
                       "Pair style {} acts between control points of type {} and atoms of type {} up to a "
                       "distance of {:.4g}, and edges of the mesh are {:.4g} long on average, up to {:.4g}: "
                       "atoms get through the surface between control points; use a cutoff of an edge or more, a "
                       "finer mesh, or solvent of fix srd/mesh",
                       styles, t, other, range, edges.sum[t] / edges.count[t], edges.longest[t]);
    }
}
