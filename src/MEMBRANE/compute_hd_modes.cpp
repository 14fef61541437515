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

#include "compute_hd_modes.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fmt/format.h"
#include "force.h"
#include "group.h"
#include "math_const.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace MathConst;
using Membrane_NS::FaceGroup;
using Membrane_NS::PatchRules;
using Membrane_NS::Quadrature;

enum { FIRST_NUMBER, SECOND_NUMBER, WAVE_NUMBER, REAL, IMAGINARY, POWER, NCOLUMNS };

// what the vector holds

enum { HEIGHT, MEAN_SQUARE, PROJECTED_AREA };
enum { RADIUS, CENTRE };
static constexpr int NPLANE = PROJECTED_AREA + 1, NSPHERE = CENTRE + 3;

static constexpr int HIGHEST = 200;

// by how much the projected area of a sheet or the solid angle of a sphere may be off before the
// membrane is taken for something else: quadrature is much better on any mesh that is usable
static constexpr double MOST_ERROR = 0.05;

// waves whose lengths differ by less than this part are of one row of averages
static constexpr double SAME_LENGTH = 0.05;

/* ----------------------------------------------------------------------
   all values are intensive: they are those of the surface, however many control points it has
------------------------------------------------------------------------- */

ComputeHDModes::ComputeHDModes(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), shape(Shape::PLANE), highest(0), quadrature(Quadrature::SIX), nmodes(0),
    modes(nullptr), mesh(lmp, fmt::format("Compute {} hd/modes", id)), totals(lmp, mesh), component(0)
{
  mesh.require();
  if (narg < 5) utils::missing_cmd_args(FLERR, "compute hd/modes", error);
  if (strcmp(arg[3], "plane") == 0)
    shape = Shape::PLANE;
  else if (strcmp(arg[3], "sphere") == 0)
    shape = Shape::SPHERE;
  else
    error->all(FLERR, "Unknown compute hd/modes shape {}; known are: plane, sphere", arg[3]);
  highest = utils::inumeric(FLERR, arg[4], false, lmp);
  if (highest < 1 || highest > HIGHEST)
    error->all(FLERR, "compute hd/modes {} {}: the highest mode must be between 1 and {}", arg[3],
               arg[4], HIGHEST);
  parse(narg, arg);
  rules = std::make_unique<PatchRules>(quadrature);

  const bool plane = shape == Shape::PLANE;
  vector_flag = array_flag = 1;
  size_vector = plane ? NPLANE : NSPHERE;
  extvector = extarray = 0;
  number_modes();
  if (sampling.every > 0) {
    begin_averages();
  } else {
    array = modes;
    size_array_rows = nmodes;
    size_array_cols = NCOLUMNS;
  }
  vector = new double[size_vector]();
}

ComputeHDModes::~ComputeHDModes()
{
  if (averages && modify->nfix) modify->delete_fix(name_of_averages());
  delete[] vector;
  if (array != modes) memory->destroy(array);
  memory->destroy(modes);
}

/* ---------------------------------------------------------------------- */

void ComputeHDModes::parse(int narg, char **arg)
{
  for (int iarg = 5; iarg < narg;) {
    const int words = sampling.parse(lmp, "compute hd/modes", iarg, narg, arg);
    iarg += words;
    if (words) continue;
    if (strcmp(arg[iarg], "quadrature") != 0)
      error->all(FLERR, "Unknown compute hd/modes keyword {}; known are: quadrature, average, theory, file",
                 arg[iarg]);
    if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "compute hd/modes quadrature", error);
    if (!Membrane_NS::parse_quadrature(arg[iarg + 1], quadrature))
      error->all(FLERR, "compute hd/modes quadrature {} is not one of 1, 3, 6, 12, careful",
                 arg[iarg + 1]);
    iarg += 2;
  }
  sampling.check(lmp, "compute hd/modes");
  if (sampling.every > 0 && shape == Shape::SPHERE && highest < 2)
    error->all(FLERR, "compute hd/modes sphere {} average: averages begin with degree 2", highest);
}

/* ----------------------------------------------------------------------
   in the order of the ground floor's sums
------------------------------------------------------------------------- */

void ComputeHDModes::number_modes()
{
  const bool plane = shape == Shape::PLANE;
  nmodes = plane ? Membrane_NS::count_waves(highest) : Membrane_NS::count_harmonics(highest);
  memory->create(modes, nmodes, NCOLUMNS, "hd/modes:modes");
  std::fill_n(modes[0], nmodes * NCOLUMNS, 0.0);
  int row = 0;
  if (plane)
    for (int nx = 0; nx <= highest; ++nx)
      for (int ny = nx == 0 ? 1 : -highest; ny <= highest; ++ny, ++row) {
        modes[row][FIRST_NUMBER] = nx;
        modes[row][SECOND_NUMBER] = ny;
      }
  else
    for (int l = 0; l <= highest; ++l)
      for (int m = -l; m <= l; ++m, ++row) {
        modes[row][FIRST_NUMBER] = l;
        modes[row][SECOND_NUMBER] = m;
      }
}

/* ---------------------------------------------------------------------- */

std::string ComputeHDModes::name_of_averages() const
{
  return fmt::format("{}_HD_SAMPLES", id);
}

void ComputeHDModes::begin_averages()
{
  std::vector<double> number(nmodes);
  for (int i = 0; i < nmodes; ++i)
    number[i] = shape == Shape::PLANE ? wave_number(i) : modes[i][FIRST_NUMBER] > 1 ? modes[i][FIRST_NUMBER] : 0.0;
  averages = std::make_unique<ModeAverages>(lmp, number, shape == Shape::PLANE ? SAME_LENGTH : 0.0);
  size_array_rows = averages->num_rows();
  size_array_cols = ModeAverages::NCOLUMNS;
  memory->create(array, size_array_rows, size_array_cols, "hd/modes:array");
  ++size_vector;    // the number of samples
  modify->add_fix(fmt::format("{} {} HD/SAMPLES {} {}", name_of_averages(), group->names[igroup],
                              sampling.every, id));
}

double ComputeHDModes::wave_number(int i) const
{
  const double *inverse = domain->h_inv, nx = modes[i][FIRST_NUMBER], ny = modes[i][SECOND_NUMBER];
  return MY_2PI * std::hypot(nx * inverse[0], nx * inverse[5] + ny * inverse[1]);
}

/* ---------------------------------------------------------------------- */

void ComputeHDModes::take_sample()
{
  measure();
  std::vector<double> number(nmodes), power(nmodes), theory(nmodes);
  for (int i = 0; i < nmodes; ++i) {
    number[i] = modes[i][WAVE_NUMBER];
    power[i] = modes[i][POWER];
    theory[i] = shape == Shape::PLANE ? sampling.wave_power(number[i], vector[PROJECTED_AREA])
                                      : sampling.harmonic_power(number[i], vector[RADIUS]);
  }
  averages->add(number, power, theory);
}

void ComputeHDModes::finish_samples()
{
  if (!sampling.file.empty() && averages->count() > 0)
    averages->write(sampling, fmt::format("compute {} hd/modes", id));
}

/* ---------------------------------------------------------------------- */

void ComputeHDModes::init()
{
  if (mesh.init() == MeshChange::TOPOLOGY) forget_samples();
  choose_membrane();
}

// those of other control points

void ComputeHDModes::forget_samples()
{
  if (!averages || averages->count() == 0) return;
  if (comm->me == 0)
    utils::logmesg(lmp, "Compute {} hd/modes: membranes have changed, averages begin anew\n", id);
  averages->begin_anew();
}

/* ----------------------------------------------------------------------
   the one membrane of the group: one connected surface of the right kind
------------------------------------------------------------------------- */

void ComputeHDModes::choose_membrane()
{
  const auto &topology = mesh->topology();
  const int ncomponents = topology.num_components();
  std::vector<int> here(ncomponents, 0), inside(ncomponents);
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = mesh->vertex(atom->tag[i]);
    if (v >= 0 && atom->mask[i] & groupbit) ++here[topology.component(v)];
  }
  MPI_Allreduce(here.data(), inside.data(), ncomponents, MPI_INT, MPI_SUM, world);

  const char *name = group->names[igroup];
  component = -1;
  for (int c = 0; c < ncomponents; ++c) {
    if (inside[c] == 0) continue;
    if (component >= 0)
      error->all(
          FLERR,
          "Compute {} hd/modes: group {} has more than one connected membrane surface; modes "
          "are those of one: use a group of its own for each, as group one molecule {}",
          id, name, mesh->molecule(component));
    if (inside[c] != topology.num_vertices(c))
      error->all(FLERR,
                 "Compute {} hd/modes: group {} has {} of the {} control points of membrane {}; "
                 "modes are those of a whole membrane: use a group that has all of them",
                 id, name, inside[c], topology.num_vertices(c), mesh->molecule(c));
    component = c;
  }
  if (component < 0)
    error->all(FLERR,
               "Compute {} hd/modes: group {} has no membrane: define the group and the compute "
               "after create_membrane or read_data",
               id, name);

  const tagint molecule = mesh->molecule(component);
  if (shape == Shape::PLANE && mesh->is_closed(component))
    error->all(FLERR,
               "Compute {} hd/modes plane: membrane {} is closed, not a sheet through the periodic "
               "box: use compute hd/modes sphere",
               id, molecule);
  if (shape == Shape::SPHERE && !mesh->is_closed(component))
    error->all(FLERR,
               "Compute {} hd/modes sphere: membrane {} continues through the periodic box and is "
               "not closed: use compute hd/modes plane",
               id, molecule);
  if (shape == Shape::SPHERE && topology.euler_characteristic(component) != 2)
    error->all(FLERR,
               "Compute {} hd/modes sphere: membrane {} has handles (Euler characteristic {}) and "
               "no spherical harmonics: use compute membrane/shape",
               id, molecule, topology.euler_characteristic(component));

  heights.clear();
}

/* ---------------------------------------------------------------------- */

void ComputeHDModes::setup()
{
  if (shape == Shape::PLANE) join_heights();
}

/* ----------------------------------------------------------------------
   a sheet that crosses the box in z may have come with image flags that do not put it in one piece;
   from now on LAMMPS keeps track of what they lack
------------------------------------------------------------------------- */

void ComputeHDModes::join_heights()
{
  heights.clear();
  mesh->refresh();
  if (!domain->zperiodic) return;

  const auto &topology = mesh->topology();
  std::vector<int> lacking(topology.num_vertices(), 0);
  int any = 0, all;
  for (const auto &[i, v] : mesh->owned_points()) {
    if (topology.component(v) != component) continue;
    double unwrapped[3];
    domain->unmap(atom->x[i], atom->image[i], unwrapped);
    const double off = mesh->unwrapped()[3 * (size_t) v + 2] - unwrapped[2];
    lacking[v] = static_cast<int>(std::lround(off / domain->zprd));
    if (lacking[v]) any = 1;
  }
  MPI_Allreduce(&any, &all, 1, MPI_INT, MPI_MAX, world);
  if (!all) return;
  heights.resize(lacking.size());
  MPI_Allreduce(lacking.data(), heights.data(), lacking.size(), MPI_INT, MPI_SUM, world);
}

/* ----------------------------------------------------------------------
   after reneighbouring: faces of this rank that are part of the membrane
------------------------------------------------------------------------- */

void ComputeHDModes::localize()
{
  groups.clear();
  int slot = 0;
  for (const FaceGroup &all : mesh->local_groups(*rules)) {
    std::vector<int> chosen;
    for (int s = 0; s < all.nfaces; ++s)
      if (totals.component_of(all, s) == component) chosen.push_back(s);
    if (chosen.empty()) continue;

    FaceGroup group;
    group.rule = all.rule;
    group.first_slot = slot;
    group.nfaces = chosen.size();
    group.points.resize((size_t) group.nslots() * group.rule->size);
    for (int s = 0; s < group.nslots(); ++s) {
      const int from = chosen[std::min(s, group.nfaces - 1)];
      for (int k = 0; k < group.rule->size; ++k) group.point(s, k) = all.point(from, k);
      if (s < group.nfaces) group.face.push_back(all.face[from]);
    }
    slot += group.nslots();
    groups.push_back(std::move(group));
  }
  model.resize(slot);
  if (shape == Shape::SPHERE) totals.place(groups, model);
}

/* ---------------------------------------------------------------------- */

void ComputeHDModes::measure()
{
  const MeshChange changed = mesh.follow();
  if (changed == MeshChange::TOPOLOGY) {
    forget_samples();
    choose_membrane();
    setup();
  }
  if (changed != MeshChange::NOTHING) localize();
  if (shape == Shape::PLANE) place_heights();
  points.take(groups, atom->nlocal ? reinterpret_cast<const double(*)[3]>(atom->x[0]) : nullptr, model);
  if (shape == Shape::PLANE)
    measure_plane();
  else
    measure_sphere();
}

/* ----------------------------------------------------------------------
   images in z are told apart; those in x and y look the same to waves
------------------------------------------------------------------------- */

void ComputeHDModes::place_heights()
{
  const double *h = domain->h;
  for (const FaceGroup &group : groups)
    for (int s = 0; s < group.nslots(); ++s) {
      const int v = mesh->topology().face(group.face[std::min(s, group.nfaces - 1)])[0];
      const int i = atom->map(mesh->tag(v));
      const int image =
          (int) (atom->image[i] >> IMG2BITS) - IMGMAX + (heights.empty() ? 0 : heights[v]);
      double *origin = &model.origin[3 * (size_t) (group.first_slot + s)];
      origin[0] = -image * h[4];
      origin[1] = -image * h[3];
      origin[2] = -image * h[2];
    }
}

/* ----------------------------------------------------------------------
   h_q = (1/A) integral (z - <z>) exp(-i q.r) n_z dA over the projected area A; the sign of n_z,
   should normals point down, cancels against that of A
------------------------------------------------------------------------- */

void ComputeHDModes::measure_plane()
{
  double my_moments[2] = {0.0, 0.0}, moments[2];
  sheet_moments(points, my_moments);
  MPI_Allreduce(my_moments, moments, 2, MPI_DOUBLE, MPI_SUM, world);
  const double area = moments[0], box_area = domain->h[0] * domain->h[1];
  if (!(std::fabs(std::fabs(area) / box_area - 1.0) < MOST_ERROR))
    error->all(
        FLERR,
        "Compute {} hd/modes plane: the projected area of membrane {} is {:.6g}, but that of "
        "the box is {:.6g}: the membrane must continue through the box in x and y",
        id, mesh->molecule(component), std::fabs(area), box_area);

  Membrane_NS::SheetFrame frame;
  const double *inverse = domain->h_inv;
  frame.s_x = inverse[0];
  frame.s_y = inverse[5];
  frame.t_y = inverse[1];
  frame.height = moments[1] / area;

  mine.assign(2 * (1 + (size_t) nmodes), 0.0);
  sums.resize(mine.size());
  sheet_waves(points, frame, highest, mine.data());
  MPI_Allreduce(mine.data(), sums.data(), mine.size(), MPI_DOUBLE, MPI_SUM, world);

  vector[HEIGHT] = frame.height;
  vector[MEAN_SQUARE] = sums[0] / area;
  vector[PROJECTED_AREA] = box_area;
  for (int i = 0; i < nmodes; ++i)
    set_row(i, wave_number(i), sums[2 * (i + 1)] / area, sums[2 * (i + 1) + 1] / area);
}

/* ----------------------------------------------------------------------
   u_lm = integral (r/R - 1) Y_lm dOmega about the centroid of the enclosed volume. The harmonics of
   r/R0 - 1, with R0 the radius of the volume, give the mean radius R and those of r/R - 1
------------------------------------------------------------------------- */

void ComputeHDModes::measure_sphere()
{
  double my_moments[4] = {0.0, 0.0, 0.0, 0.0}, moments[4];
  sphere_moments(points, my_moments);
  MPI_Allreduce(my_moments, moments, 4, MPI_DOUBLE, MPI_SUM, world);
  const double volume = moments[0];
  if (!(volume > 0.0))
    error->all(FLERR,
               "Compute {} hd/modes sphere: membrane {} encloses the volume {:.6g}: its faces are "
               "inside out; reverse the order of their corners",
               id, mesh->molecule(component), volume);
  double off[3];
  for (int k = 0; k < 3; ++k) {
    off[k] = moments[1 + k] / volume;
    vector[CENTRE + k] = totals.components()[component].centre[k] + off[k];
  }

  const double first = std::cbrt(volume / (2.0 * MY_2PI / 3.0));
  mine.assign((size_t) nmodes + 1, 0.0);
  sums.resize(mine.size());
  sphere_harmonics(points, off, first, highest, mine.data());
  MPI_Allreduce(mine.data(), sums.data(), mine.size(), MPI_DOUBLE, MPI_SUM, world);

  const double solid_angle = sums[nmodes];
  if (!(std::fabs(solid_angle / (2.0 * MY_2PI) - 1.0) < MOST_ERROR))
    error->all(FLERR,
               "Compute {} hd/modes sphere: membrane {} covers the solid angle {:.6g} pi about its "
               "centroid, not 4 pi: it is too far from a sphere for spherical harmonics",
               id, mesh->molecule(component), solid_angle / MY_PI);

  const double stretch = 1.0 + sums[0] * 2.0 * std::sqrt(MY_PI) / solid_angle;
  vector[RADIUS] = stretch * first;
  set_row(0, 0.0, 0.0, 0.0);
  for (int i = 1; i < nmodes; ++i) set_row(i, modes[i][FIRST_NUMBER], sums[i] / stretch, 0.0);
}

/* ---------------------------------------------------------------------- */

void ComputeHDModes::set_row(int i, double wave_number, double re, double im)
{
  modes[i][WAVE_NUMBER] = wave_number;
  modes[i][REAL] = re;
  modes[i][IMAGINARY] = im;
  modes[i][POWER] = re * re + im * im;
}

/* ---------------------------------------------------------------------- */

void ComputeHDModes::compute_array()
{
  const bool measured = (invoked_flag & Compute::INVOKED_VECTOR) && invoked_vector == update->ntimestep;
  invoked_array = update->ntimestep;
  if (averages)
    averages->fill(array);
  else if (!measured)
    measure();
}

void ComputeHDModes::compute_vector()
{
  const bool measured = !averages && (invoked_flag & Compute::INVOKED_ARRAY) &&
      invoked_array == update->ntimestep;
  invoked_vector = update->ntimestep;
  if (!measured) measure();
  if (averages) vector[size_vector - 1] = static_cast<double>(averages->count());
}

/* ---------------------------------------------------------------------- */

double ComputeHDModes::memory_usage()
{
  double bytes = sizeof(double) * ((double) nmodes * NCOLUMNS + size_vector);
  for (const FaceGroup &group : groups)
    bytes += sizeof(int) * (group.points.capacity() + group.face.capacity());
  bytes += sizeof(double) * (13.0 * count_slots(groups) + mine.capacity() + sums.capacity());
  bytes += sizeof(Membrane_NS::Lane3) * 2.0 * points.r.capacity();
  return bytes + sizeof(int) * heights.capacity() + rules->memory_usage();
}
