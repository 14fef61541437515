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

#include "hd_mode_space.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "membrane_tessellation.h"
#include "mesh_local.h"
#include "mesh_part.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using Membrane_NS::MassKind;
using Membrane_NS::ModeSpace;
using Membrane_NS::SharedModes;
using Membrane_NS::TriangleMesh;

static constexpr int HIGHEST = 200;

// a sheet is that of another box if a box vector differs by more than this part
static constexpr double SAME_BOX = 1.0e-12;

/* ---------------------------------------------------------------------- */

int HDModeSpace::parse(int iarg, int narg, char **arg, Membrane_NS::MassOperator::Settings &settings)
{
  const std::string key = arg[iarg];
  if (key != "modes" && key != "relax") return 0;
  if (!settings.modes) {
    if (key == "relax") error->all(FLERR, "{} relax is friction of modes: say modes before it", user);
    settings.modes = std::make_shared<SharedModes>();
  }
  return key == "modes" ? parse_modes(iarg, narg, arg, *settings.modes)
                        : parse_relax(iarg, narg, arg, *settings.modes);
}

int HDModeSpace::parse_modes(int iarg, int narg, char **arg, SharedModes &modes)
{
  Choice &choice = modes.choice;
  auto word = [&](int i) -> std::string {
    if (iarg + i >= narg) utils::missing_cmd_args(FLERR, user + " modes", error);
    return arg[iarg + i];
  };
  auto integer = [&](int i) { return utils::inumeric(FLERR, word(i), false, lmp); };

  const std::string shape = word(1);
  choice = Choice();
  if (shape == "file") {
    choice.shape = Choice::Shape::FILE;
    modes.file = word(2);
    return 3;
  }
  if (shape != "plane" && shape != "sphere")
    error->all(FLERR, "{} modes {} is not plane, sphere or file", user, shape);
  const bool sphere = shape == "sphere";
  choice.shape = sphere ? Choice::Shape::SPHERE : Choice::Shape::PLANE;
  if (!sphere && word(2) != "min") {
    choice.one = true;
    choice.nx = integer(2);
    choice.ny = integer(3);
    if (choice.nx == 0 && choice.ny == 0)
      error->all(FLERR, "{} modes plane 0 0 moves the sheet as a whole, which is no mode", user);
    if (choice.nx < 0 || (choice.nx == 0 && choice.ny < 0)) {    // the same wave
      choice.nx = -choice.nx;
      choice.ny = -choice.ny;
    }
    choice.highest = std::max(choice.nx, std::abs(choice.ny));
    return 4;
  }
  if (word(2) != "min" || word(4) != "max")
    error->all(FLERR, "{} modes {} must be followed by min N max M{}", user, shape,
               sphere ? "" : " or the two numbers of a wave");
  choice.lowest = integer(3);
  choice.highest = integer(5);
  if (sphere && choice.lowest == 1)
    error->all(FLERR,
               "{} modes sphere min 1: l = 1 moves a sphere as a whole, which is no mode: begin with 2, or with 0 for "
               "the radius and those from 2", user);
  if (!sphere && choice.lowest < 1)
    error->all(FLERR, "{} modes plane min {} must be 1 or more: 0 moves the sheet as a whole", user, word(3));
  if (choice.lowest < 0 || choice.highest < std::max(choice.lowest, sphere ? 2 : 1) || choice.highest > HIGHEST)
    error->all(FLERR, "{} modes {} min {} max {}: max must be between min and {}, and {} at least", user, shape,
               word(3), word(5), HIGHEST, sphere ? 2 : 1);
  return 6;
}

int HDModeSpace::parse_relax(int iarg, int narg, char **arg, SharedModes &modes)
{
  if (iarg + 3 > narg) utils::missing_cmd_args(FLERR, user + " relax", error);
  const std::string kind = arg[iarg + 1], value = arg[iarg + 2];
  modes.viscosity = 0.0;
  modes.times.clear();
  if (kind == "eta") {
    modes.viscosity = utils::numeric(FLERR, value, false, lmp);
    if (!(modes.viscosity > 0.0) || !std::isfinite(modes.viscosity))
      error->all(FLERR, "{} relax eta {}: the viscosity must be positive", user, value);
  } else if (kind == "time") {
    for (const auto &row : read_table(value, "relax time")) {
      if (row.size() < 2 || row.size() > 3 || !(row.back() > 0.0))
        error->all(FLERR, "{} relax time {}: a line has l (or nx ny, or the number of a mode) and a positive time",
                   user, value);
      const auto second = static_cast<int>(row.size() == 3 ? row[1] : 0.0);
      modes.times[{static_cast<int>(row[0]), second}] = row.back();
    }
    if (modes.times.empty()) error->all(FLERR, "{} relax time {}: the file has no times", user, value);
  } else
    error->all(FLERR, "{} relax {} is not eta or time", user, kind);
  return 3;
}

void HDModeSpace::check(const Membrane_NS::MassOperator::Settings &settings) const
{
  if (!settings.modes) return;
  const SharedModes &modes = *settings.modes;
  if (settings.kind == MassKind::SAMPLING)
    error->all(FLERR, "{} mass sampling moves all control points: leave modes out, or take another mass", user);
  if (modes.choice.highest == 0 && modes.choice.shape != Choice::Shape::FILE)
    error->all(FLERR, "{} relax is friction of modes: say modes, too", user);
  if (modes.viscosity > 0.0 && modes.choice.shape == Choice::Shape::FILE)
    error->all(FLERR, "{} relax eta: modes of a file have no wavelength; use relax time", user);
}

/* ----------------------------------------------------------------------
   numbers of the lines of a file, without comments; read on one rank
------------------------------------------------------------------------- */

std::vector<std::vector<double>> HDModeSpace::read_table(const std::string &file, const std::string &what) const
{
  std::string text;
  int size = -1;
  if (comm->me == 0) {
    std::ifstream in(file);
    std::ostringstream all;
    if (in) all << in.rdbuf();
    text = all.str();
    size = in ? static_cast<int>(text.size()) : -1;
  }
  MPI_Bcast(&size, 1, MPI_INT, 0, world);
  if (size < 0) error->all(FLERR, "{} {}: cannot read file {}", user, what, file);
  text.resize(size);
  MPI_Bcast(text.data(), size, MPI_CHAR, 0, world);

  std::vector<std::vector<double>> rows;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::vector<double> row;
    std::string word;
    while (words >> word) {
      if (!utils::is_double(word))
        error->all(FLERR, "{} {}: line {} of file {}: {} is no number", user, what, number, file, word);
      row.push_back(std::stod(word));
    }
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

/* ---------------------------------------------------------------------- */

int HDModeSpace::count_rows(const SharedModes &modes, int groupbit) const
{
  auto rows = static_cast<int>(modes.choice.list().size());
  if (modes.choice.shape == Choice::Shape::PLANE) rows /= 2;
  if (modes.choice.shape == Choice::Shape::FILE) {
    const auto table = read_table(modes.file, "modes file");
    rows = table.empty() ? 0 : static_cast<int>(table.front().size()) / 3;
  }
  return rows * count_membranes(groupbit);
}

int HDModeSpace::count_membranes(int groupbit) const
{
  LocalMesh mesh(lmp, user);
  mesh.require();
  mesh.init();
  const int n = mesh->topology().num_components();
  std::vector<int> mine(n, 0), all(n);
  for (int i = 0; i < atom->nlocal; ++i) {
    const int v = atom->mask[i] & groupbit ? mesh->vertex(atom->tag[i]) : -1;
    if (v >= 0) mine[mesh->topology().component(v)] = 1;
  }
  MPI_Allreduce(mine.data(), all.data(), n, MPI_INT, MPI_MAX, world);
  return static_cast<int>(std::count(all.begin(), all.end(), 1));
}

std::vector<int> HDModeSpace::components_of(const DistributedMesh &mesh, const MeshPart &part) const
{
  const int n = mesh.topology().num_components();
  std::vector<int> mine(n, 0), all(n), components;
  for (int i = 0; i < part.owned; ++i) mine[mesh.topology().component(part.vertices[i])] = 1;
  MPI_Allreduce(mine.data(), all.data(), n, MPI_INT, MPI_MAX, world);
  for (int c = 0; c < n; ++c)
    if (all[c]) components.push_back(c);
  return components;
}

/* ---------------------------------------------------------------------- */

void HDModeSpace::follow(DistributedMesh &mesh, MeshPart &part, SharedModes &modes) const
{
  const auto &topology = mesh.topology();
  const TriangleMesh present = mesh.triangle_mesh();
  const bool plane = modes.choice.shape == Choice::Shape::PLANE;
  const bool known = !modes.shape.points.empty();
  const auto components = components_of(mesh, part);
  const bool same = known && modes.shape.faces == topology.faces() &&
      modes.shape.points.size() == present.points.size() && modes.frames.size() == components.size() &&
      (!plane || (modes.shape.lattice - present.lattice).norm() <= SAME_BOX * present.lattice.norm());
  if (same && modes.now) return;
  for (int c : components) check_membrane(mesh, c, modes.choice);
  if (!same) {
    if (known && comm->me == 0)
      utils::logmesg(lmp, "{} modes: {} changed, the reference of the modes is taken anew\n", user,
                     modes.shape.faces == topology.faces() ? "the box has" : "control points have");
    modes.shape = present;
    modes.frames.clear();
    modes.friction.clear();
    for (int c : components) {
      try {
        modes.frames.push_back(find_reference(topology, c, present, modes.choice, modes.shape));
      } catch (const Membrane_NS::ModeError &err) {
        error->all(FLERR, "{} modes: membrane {} {}", user, mesh.molecule(c), err.what());
      }
    }
  }
  build(mesh, components, modes);
  ++modes.renewals;
}

void HDModeSpace::check_membrane(const DistributedMesh &mesh, int component, const Choice &choice) const
{
  const tagint molecule = mesh.molecule(component);
  if (choice.shape == Choice::Shape::SPHERE) {
    if (!mesh.is_closed(component))
      error->all(FLERR, "{} modes sphere: membrane {} continues through the periodic box and is no sphere: use modes "
                        "plane", user, molecule);
    if (mesh.topology().euler_characteristic(component) != 2)
      error->all(FLERR, "{} modes sphere: membrane {} has handles and is no sphere: use modes file", user, molecule);
  } else if (choice.shape == Choice::Shape::PLANE) {
    const auto continues = continuing_directions(mesh.topology(), mesh.triangle_mesh())[component];
    if (mesh.is_closed(component))
      error->all(FLERR, "{} modes plane: membrane {} is closed, no sheet: use modes sphere", user, molecule);
    if (!continues[0] || !continues[1] || continues[2])
      error->all(FLERR, "{} modes plane: membrane {} does not continue through the box in x and y alone", user,
                 molecule);
  }
}

void HDModeSpace::build(const DistributedMesh &mesh, const std::vector<int> &components, SharedModes &modes) const
{
  auto space = std::make_shared<ModeSpace>();
  space->reference = modes.shape.points;
  if (modes.choice.shape == Choice::Shape::FILE)
    read_vectors(mesh, components, modes, *space);
  else
    for (size_t m = 0; m < components.size(); ++m) {
      try {
        space->membranes.push_back(make_modes(mesh.topology(), components[m], modes.shape, modes.frames[m],
                                              modes.choice));
      } catch (const Membrane_NS::ModeError &err) {
        error->all(FLERR, "{} modes: membrane {} {}", user, mesh.molecule(components[m]), err.what());
      }
    }
  modes.now = space;
  if (modes.viscosity > 0.0) set_friction(modes);
}

/* ----------------------------------------------------------------------
   an atom ID and the displacement of the atom in each of the modes, a line an atom
------------------------------------------------------------------------- */

void HDModeSpace::read_vectors(const DistributedMesh &mesh, const std::vector<int> &components,
                               const SharedModes &modes, ModeSpace &space) const
{
  const auto rows = read_table(modes.file, "modes file");
  const auto &topology = mesh.topology();
  const size_t length = rows.empty() ? 0 : rows.front().size();
  if (length < 4 || length % 3 != 1)
    error->all(FLERR, "{} modes file {}: a line has an atom ID and three numbers for each mode", user, modes.file);
  const size_t count = (length - 1) / 3;
  std::vector<std::vector<Vector3d>> vectors(count,
                                             std::vector<Vector3d>(topology.num_vertices(), Vector3d::Zero()));
  std::vector<char> found(topology.num_vertices(), 0);
  for (const auto &row : rows) {
    const int v = mesh.vertex(static_cast<tagint>(row[0]));
    if (row.size() != length)
      error->all(FLERR, "{} modes file {}: the line of atom {} has {} numbers, the first has {}", user, modes.file,
                 row[0], row.size(), length);
    if (v < 0) error->all(FLERR, "{} modes file {}: atom {} is no control point", user, modes.file, row[0]);
    found[v] = 1;
    for (size_t k = 0; k < count; ++k) vectors[k][v] = Vector3d(&row[1 + 3 * k]);
  }
  for (int v = 0; v < topology.num_vertices(); ++v)
    if (!found[v] && std::find(components.begin(), components.end(), topology.component(v)) != components.end())
      error->all(FLERR, "{} modes file {}: control point {} is missing", user, modes.file, mesh.tag(v));
  for (int c : components) space.membranes.push_back(make_modes(topology, c, vectors));
}

/* ----------------------------------------------------------------------
   In solvent a force f cos(qr) per area along the normal of a sheet moves it by f/(4 eta q). A vesicle whose area is
   conserved everywhere moves by f l(l+1) R/[(2l+1)(2l^2+2l-1) eta], with the same fluid in and out. The force on an
   amplitude is f times the integral of the square of the mode.
------------------------------------------------------------------------- */

void HDModeSpace::set_friction(SharedModes &modes) const
{
  const bool sphere = modes.choice.shape == Choice::Shape::SPHERE;
  modes.friction.clear();
  for (const auto &membrane : modes.now->membranes)
    for (size_t k = 0; k < membrane.modes.size(); ++k) {
      double resistance = 4.0 * membrane.wave_number[k];
      if (sphere) {
        const double l = std::max(2, membrane.modes[k].first);    // l = 0 follows the others
        resistance = (2 * l + 1) * (2 * l * l + 2 * l - 1) / (l * (l + 1)) / membrane.length;
      }
      modes.friction.push_back(modes.viscosity * resistance * membrane.norm);
    }
}

/* ---------------------------------------------------------------------- */

void HDModeSpace::archive(RestartArchive &file, SharedModes &modes)
{
  auto points = [&file](std::vector<Vector3d> &list) {
    std::vector<double> numbers;
    for (const auto &p : list) numbers.insert(numbers.end(), p.data(), p.data() + 3);
    file(numbers);
    if (!file.is_reading()) return;
    list.clear();
    for (size_t i = 0; i + 2 < numbers.size(); i += 3) list.emplace_back(&numbers[i]);
  };
  TriangleMesh &shape = modes.shape;
  points(shape.points);
  std::vector<int> corners;
  for (const auto &face : shape.faces) corners.insert(corners.end(), face.begin(), face.end());
  file(corners);
  std::vector<double> box(shape.lattice.data(), shape.lattice.data() + 9), radii;
  file(box);
  for (bool &along : shape.periodic) file(along);
  std::vector<Vector3d> middles;
  for (const auto &frame : modes.frames) {
    middles.push_back(frame.middle);
    radii.push_back(frame.radius);
  }
  points(middles);
  file(radii);
  file(modes.friction);
  if (!file.is_reading() || !file.ok()) return;
  shape.faces.clear();
  for (size_t i = 0; i + 2 < corners.size(); i += 3)
    shape.faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
  std::copy_n(box.begin(), std::min<size_t>(box.size(), 9), shape.lattice.data());
  modes.frames.clear();
  for (size_t m = 0; m < std::min(middles.size(), radii.size()); ++m) modes.frames.push_back({middles[m], radii[m]});
  if (!modes.has_friction()) modes.friction.clear();
  modes.now.reset();
}
