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
#include "compute_membrane_shape.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fmt/format.h"
#include "group.h"
#include "math_const.h"
#include "math_extra.h"
#include "memory.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace MathConst;
using Membrane_NS::FaceGroup;
using Membrane_NS::PatchRules;
using Membrane_NS::Quadrature;

// columns

enum {
  AREA,
  VOLUME,
  REDUCED_VOLUME,
  MEAN_CURVATURE,
  WILLMORE,
  EULER,
  SHORTEST_EDGE,
  LONGEST_EDGE,
  SMALLEST_ANGLE,
  LARGEST_FOLD,
  CENTRE,
  GYRATION = CENTRE + 3,
  NCOLUMNS
};

// what the ranks add up for each connected component, and maximise for each membrane

namespace {
struct Sums {
  enum { MEAN, WILLMORE, INERTIA, MOMENT, WIDTH = MOMENT + 3 };
};
struct Extremes {
  enum { SHORTEST, LONGEST, ANGLE, FOLD, WIDTH };
};
}    // namespace

/* ---------------------------------------------------------------------- */

static Quadrature parse_arguments(LAMMPS *lmp, int narg, char **arg)
{
  Quadrature quadrature = Quadrature::SIX;
  for (int iarg = 3; iarg < narg; iarg += 2) {
    if (strcmp(arg[iarg], "quadrature") != 0)
      lmp->error->all(FLERR,
                      "Unknown compute membrane/shape keyword {}; the only one is: quadrature",
                      arg[iarg]);
    if (iarg + 2 > narg)
      utils::missing_cmd_args(FLERR, "compute membrane/shape quadrature", lmp->error);
    if (!Membrane_NS::parse_quadrature(arg[iarg + 1], quadrature))
      lmp->error->all(FLERR,
                      "compute membrane/shape quadrature {} is not one of 1, 3, 6, 12, careful",
                      arg[iarg + 1]);
  }
  return quadrature;
}

/* ----------------------------------------------------------------------
   all values are intensive: they are those of the surface, however many control points it has
------------------------------------------------------------------------- */

ComputeMembraneShape::ComputeMembraneShape(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), mesh(lmp, fmt::format("Compute {} membrane/shape", id)),
    rules(parse_arguments(lmp, narg, arg)), totals(lmp, mesh)
{
  mesh.require();
  vector_flag = array_flag = 1;
  size_vector = size_array_cols = NCOLUMNS;
  size_array_rows = 0;
  size_array_rows_variable = 1;
  extvector = extarray = 0;
  vector = new double[NCOLUMNS]();
}

ComputeMembraneShape::~ComputeMembraneShape()
{
  delete[] vector;
  memory->destroy(array);
}

/* ---------------------------------------------------------------------- */

void ComputeMembraneShape::init()
{
  mesh.init();
  choose_membranes();
}

/* ----------------------------------------------------------------------
   rows: the membranes of the group, which has all of a membrane or nothing
------------------------------------------------------------------------- */

void ComputeMembraneShape::choose_membranes()
{
  const auto &topology = mesh->topology();
  const auto &molecules = mesh->molecules();
  const int nmembranes = molecules.size();
  std::vector<int> mine(nmembranes, 0), inside(nmembranes), total(nmembranes, 0);
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = mesh->vertex(atom->tag[i]);
    if (v >= 0 && atom->mask[i] & groupbit) ++mine[mesh->membrane(topology.component(v))];
  }
  MPI_Allreduce(mine.data(), inside.data(), nmembranes, MPI_INT, MPI_SUM, world);
  for (int c = 0; c < topology.num_components(); ++c)
    total[mesh->membrane(c)] += topology.num_vertices(c);

  members.clear();
  for (int m = 0; m < nmembranes; ++m) {
    if (inside[m] == 0) continue;
    if (inside[m] != total[m])
      error->all(
          FLERR,
          "Compute {} membrane/shape: group {} has {} of the {} control points of membrane "
          "{}; a shape is that of a whole membrane: use a group that has all of them or none",
          id, group->names[igroup], inside[m], total[m], molecules[m]);
    members.push_back(m);
  }
  if (members.empty() && comm->me == 0)
    error->warning(FLERR, "Compute {} membrane/shape: group {} has no membrane", id,
                   group->names[igroup]);

  size_array_rows = members.size();
  memory->destroy(array);
  memory->create(array, MAX(size_array_rows, 1), NCOLUMNS, "membrane/shape:array");
  std::fill_n(array[0], MAX(size_array_rows, 1) * NCOLUMNS, 0.0);
}

/* ----------------------------------------------------------------------
   after reneighbouring: faces of this rank and the points across their edges
------------------------------------------------------------------------- */

void ComputeMembraneShape::localize()
{
  groups = mesh->local_groups(rules);
  const int nslots = count_slots(groups);
  model.resize(nslots);
  curvature.resize(nslots);
  beyond.assign(3 * (size_t) nslots, -1);

  const auto &topology = mesh->topology();
  for (const FaceGroup &group : groups)
    for (int s = 0; s < group.nfaces; ++s) {
      const int f = group.face[s];
      const int first =
          Membrane_NS::corner_of(topology.face(f), mesh->vertex(atom->tag[group.point(s, 0)]));
      for (int k = 0; k < 3; ++k)
        beyond[3 * (size_t) (group.first_slot + s) + k] =
            mesh->local_neighbor(group.point(s, k), topology.opposite(f, (first + k) % 3), f);
    }
}

/* ----------------------------------------------------------------------
   the triangle between three control points: lengths of its edges, its angles in degrees, and by
   how many degrees its neighbours are bent from its plane. All as maxima: minima have their sign
   reversed
------------------------------------------------------------------------- */

void ComputeMembraneShape::measure_quality(const FaceGroup &group, int s, double *extremes) const
{
  auto normal = [this](int a, int b, int c, double *n) {
    double ab[3], ac[3];
    MathExtra::sub3(atom->x[b], atom->x[a], ab);
    MathExtra::sub3(atom->x[c], atom->x[a], ac);
    MathExtra::cross3(ab, ac, n);
  };
  auto raise = [extremes](int which, double value) {
    extremes[which] = std::max(extremes[which], value);
  };
  double n[3], m[3], side[3];
  normal(group.point(s, 0), group.point(s, 1), group.point(s, 2), n);
  for (int k = 0; k < 3; ++k) {
    const int a = group.point(s, k), b = group.point(s, (k + 1) % 3),
              c = group.point(s, (k + 2) % 3);
    double ab[3], ac[3];
    MathExtra::sub3(atom->x[b], atom->x[a], ab);
    MathExtra::sub3(atom->x[c], atom->x[a], ac);
    raise(Extremes::SHORTEST, -MathExtra::len3(ab));
    raise(Extremes::LONGEST, MathExtra::len3(ab));
    raise(Extremes::ANGLE, -std::atan2(MathExtra::len3(n), MathExtra::dot3(ab, ac)) * RAD2DEG);

    normal(b, a, beyond[3 * (size_t) (group.first_slot + s) + k], m);
    MathExtra::cross3(n, m, side);
    raise(Extremes::FOLD, std::atan2(MathExtra::len3(side), MathExtra::dot3(n, m)) * RAD2DEG);
  }
}

/* ---------------------------------------------------------------------- */

void ComputeMembraneShape::measure()
{
  const MeshChange changed = mesh.follow();
  if (changed == MeshChange::TOPOLOGY) choose_membranes();
  if (changed != MeshChange::NOTHING) localize();

  const auto x = atom->nlocal ? reinterpret_cast<const double(*)[3]>(atom->x[0]) : nullptr;
  totals.measure(groups, model, integrals, {true, false});
  for (const FaceGroup &group : groups) curvature_integrals(group, x, model, curvature);

  const size_t n = mesh->molecules().size();
  const int ncomponents = mesh->topology().num_components();
  std::vector<double> my_sums((size_t) ncomponents * Sums::WIDTH, 0.0), all_sums(my_sums.size());
  std::vector<double> my_extremes(n * Extremes::WIDTH, -HUGE_VAL), all_extremes(my_extremes.size());
  for (const FaceGroup &group : groups)
    for (int s = 0; s < group.nfaces; ++s) {
      const int slot = group.first_slot + s;
      const int component = totals.component_of(group, s), m = mesh->membrane(component);
      double *sums = &my_sums[(size_t) component * Sums::WIDTH];
      sums[Sums::MEAN] += curvature.mean[slot];
      sums[Sums::WILLMORE] += curvature.willmore[slot];
      sums[Sums::INERTIA] += curvature.inertia[slot];
      for (int k = 0; k < 3; ++k) sums[Sums::MOMENT + k] += curvature.moment[3 * (size_t) slot + k];
      measure_quality(group, s, &my_extremes[(size_t) m * Extremes::WIDTH]);
    }
  MPI_Allreduce(my_sums.data(), all_sums.data(), my_sums.size(), MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(my_extremes.data(), all_extremes.data(), my_extremes.size(), MPI_DOUBLE, MPI_MAX,
                world);

  for (int i = 0; i < size_array_rows; ++i) {
    const int m = members[i];
    const auto &membrane = totals.membranes()[m];
    const double *extremes = &all_extremes[(size_t) m * Extremes::WIDTH];
    double *row = array[i];
    row[AREA] = membrane.area;
    row[VOLUME] = mesh->is_closed_membrane(m) ? membrane.volume : 0.0;
    row[REDUCED_VOLUME] = row[VOLUME] * 6.0 * std::sqrt(MY_PI) / std::pow(row[AREA], 1.5);
    row[SHORTEST_EDGE] = -extremes[Extremes::SHORTEST];
    row[LONGEST_EDGE] = extremes[Extremes::LONGEST];
    row[SMALLEST_ANGLE] = -extremes[Extremes::ANGLE];
    row[LARGEST_FOLD] = extremes[Extremes::FOLD];
  }
  combine_components(all_sums);
}

/* ----------------------------------------------------------------------
   columns that are sums over the components of a membrane, whose moments are about their own centres.
   The second moment is shifted to the centre of the area, and not to the box's origin, where it
   would lose digits: sum (r - C)^2 = sum (r - o)^2 + 2 (o - C).sum (r - o) + A (o - C)^2
------------------------------------------------------------------------- */

void ComputeMembraneShape::combine_components(const std::vector<double> &all_sums)
{
  const auto &topology = mesh->topology();
  std::vector<double *> row_of(mesh->molecules().size(), nullptr);
  for (int i = 0; i < size_array_rows; ++i) {
    row_of[members[i]] = array[i];
    for (int k : {MEAN_CURVATURE, WILLMORE, EULER, GYRATION}) array[i][k] = 0.0;
    std::fill_n(array[i] + CENTRE, 3, 0.0);
  }
  auto each_component = [&](auto &&add) {
    for (int c = 0; c < topology.num_components(); ++c)
      if (double *row = row_of[mesh->membrane(c)])
        add(c, totals.components()[c], &all_sums[(size_t) c * Sums::WIDTH], row);
  };
  each_component([&](int c, const MeshTotals::Total &part, const double *sums, double *row) {
    row[MEAN_CURVATURE] += sums[Sums::MEAN];
    row[WILLMORE] += sums[Sums::WILLMORE];
    row[EULER] += topology.euler_characteristic(c);
    for (int k = 0; k < 3; ++k)
      row[CENTRE + k] += (sums[Sums::MOMENT + k] + part.area * part.centre[k]) / row[AREA];
  });
  each_component([](int, const MeshTotals::Total &part, const double *sums, double *row) {
    double shift[3];
    MathExtra::sub3(part.centre, row + CENTRE, shift);
    row[GYRATION] += (sums[Sums::INERTIA] + 2.0 * MathExtra::dot3(shift, sums + Sums::MOMENT) +
                      part.area * MathExtra::lensq3(shift)) / row[AREA];
  });
  for (int i = 0; i < size_array_rows; ++i)
    array[i][GYRATION] =
        mesh->is_closed_membrane(members[i]) ? std::sqrt(array[i][GYRATION]) : 0.0;
}

/* ---------------------------------------------------------------------- */

void ComputeMembraneShape::compute_array()
{
  invoked_array = update->ntimestep;
  measure();
}

/* ----------------------------------------------------------------------
   all membranes together: sums, worst elements, mean reduced volume of those that have a volume,
   centre and radius of gyration of the whole area
------------------------------------------------------------------------- */

void ComputeMembraneShape::compute_vector()
{
  invoked_vector = update->ntimestep;
  measure();

  std::fill_n(vector, NCOLUMNS, 0.0);
  int nclosed = 0;
  for (int i = 0; i < size_array_rows; ++i) {
    const double *row = array[i];
    for (int k : {AREA, VOLUME, REDUCED_VOLUME, MEAN_CURVATURE, WILLMORE, EULER})
      vector[k] += row[k];
    for (int k : {SHORTEST_EDGE, SMALLEST_ANGLE})
      vector[k] = i == 0 ? row[k] : std::min(vector[k], row[k]);
    for (int k : {LONGEST_EDGE, LARGEST_FOLD}) vector[k] = std::max(vector[k], row[k]);
    for (int k = CENTRE; k < CENTRE + 3; ++k) vector[k] += row[AREA] * row[k];
    nclosed += mesh->is_closed_membrane(members[i]);
  }
  if (nclosed) vector[REDUCED_VOLUME] /= nclosed;
  if (size_array_rows == 0) return;
  for (int k = CENTRE; k < CENTRE + 3; ++k) vector[k] /= vector[AREA];
  if (nclosed < size_array_rows) return;
  double inertia = 0.0;
  for (int i = 0; i < size_array_rows; ++i) {
    double shift[3];
    MathExtra::sub3(array[i] + CENTRE, vector + CENTRE, shift);
    inertia += array[i][AREA] * (array[i][GYRATION] * array[i][GYRATION] + MathExtra::lensq3(shift));
  }
  vector[GYRATION] = std::sqrt(inertia / vector[AREA]);
}

/* ---------------------------------------------------------------------- */

double ComputeMembraneShape::memory_usage()
{
  double bytes = sizeof(double) * ((double) size_array_rows + 1.0) * NCOLUMNS;
  for (const FaceGroup &group : groups)
    bytes += sizeof(int) * (group.points.capacity() + group.face.capacity());
  bytes += sizeof(int) * beyond.capacity();
  bytes += sizeof(double) * 19.0 * count_slots(groups);
  return bytes + rules.memory_usage();
}
