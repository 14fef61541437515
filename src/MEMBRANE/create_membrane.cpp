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

#include "create_membrane.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "membrane_mesh_file.h"
#include "membrane_mesh_orientation.h"
#include "membrane_mesh_shapes.h"
#include "memory.h"
#include "mesh_box.h"
#include "mesh_distributed.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using Membrane_NS::Face;
using Membrane_NS::MeshError;
using Membrane_NS::TriangleMesh;

// boxes, half of what image flags can count
static constexpr int FARTHEST = IMGMAX / 2;

/* ---------------------------------------------------------------------- */

CreateMembrane::CreateMembrane(LAMMPS *lmp) :
    Command(lmp), type(0), angle_type(1), refine(0), molecule(0), first_molecule(0),
    last_molecule(0), mass(1.0), interpolated(false),
    flip(false), centre{0.0, 0.0, 0.0}, scale{1.0, 1.0, 1.0}, centred(true), axis(-1)
{
}

/* ---------------------------------------------------------------------- */

void CreateMembrane::command(int narg, char **arg)
{
  if (!domain->box_exist) error->all(FLERR, "create_membrane needs a box: use create_box first");
  DistributedMesh::of(lmp, "create_membrane");
  if (domain->dimension != 3) error->all(FLERR, "create_membrane needs dimension 3");
  if (narg < 3) utils::missing_cmd_args(FLERR, "create_membrane", error);

  type = utils::expand_type_int(FLERR, arg[0], Atom::ATOM, lmp);
  if (type < 1 || type > atom->ntypes)
    error->all(FLERR, "create_membrane type {} is not one of the {} atom types of the box", arg[0],
               atom->ntypes);
  if (atom->nangletypes < 1)
    error->all(FLERR,
               "create_membrane needs an angle type for its faces: add angle/types 1 to "
               "create_box");

  TriangleMesh mesh;
  mesh.periodic = periodic_directions(*domain);
  mesh.lattice = box_vectors(*domain);
  for (int k = 0; k < 3; ++k) centre[k] = 0.5 * (domain->boxlo[k] + domain->boxhi[k]);
  if (domain->triclinic) {
    double half[3] = {0.5, 0.5, 0.5};
    domain->lamda2x(half, centre);
  }

  std::string inside_out;
  try {
    const int used = parse_shape(narg - 1, arg + 1, mesh);
    parse_options(narg - 1 - used, arg + 1 + used);
    if (shape == "file") read_file(mesh);

    for (auto &p : mesh.points)
      for (int k = 0; k < 3; ++k) p[k] = scale[k] * p[k] + (centred ? centre[k] : 0.0);

    check_edges(mesh);
    inside_out = turn(mesh);
    if (interpolated) mesh = Membrane_NS::interpolate(mesh);
    for (int i = 0; i < refine; ++i) mesh = Membrane_NS::loop_refine(mesh);
  } catch (const MeshError &err) {
    error->all(FLERR, "create_membrane {}: {}", shape, err.what());
  }

  add_atoms(mesh);
  if (comm->me == 0) {
    if (!report.empty()) utils::logmesg(lmp, "Read {}: {}\n", path, report);
    const std::string names = last_molecule > first_molecule
        ? fmt::format("membranes {} to {}", first_molecule, last_molecule)
        : fmt::format("membrane {}", first_molecule);
    utils::logmesg(lmp, "Created {}: {} control points, {} faces\n", names, mesh.points.size(),
                   mesh.faces.size());
    if (!inside_out.empty())
      error->warning(
          FLERR,
          "create_membrane {}: {} inside out, faces run clockwise as seen from outside, which "
          "changes the sign of c0 and of pressure; flip yes turns the faces",
          shape == "file" ? path : shape, inside_out);
  }
}

/* ----------------------------------------------------------------------
   the shape and its numbers; returns how many words it took
------------------------------------------------------------------------- */

int CreateMembrane::parse_shape(int narg, char **arg, TriangleMesh &mesh)
{
  shape = arg[0];
  auto need = [&](int n) {
    if (narg < n + 1) utils::missing_cmd_args(FLERR, "create_membrane " + shape, error);
  };
  auto number = [&](int i) {
    return utils::numeric(FLERR, arg[i], false, lmp);
  };
  auto integer = [&](int i) {
    return utils::inumeric(FLERR, arg[i], false, lmp);
  };

  const auto lattice = mesh.lattice;
  const auto periodic = mesh.periodic;
  int used = 0;
  if (shape == "sphere") {
    need(2);
    mesh = Membrane_NS::icosphere(integer(1), number(2));
    used = 3;
  } else if (shape == "plane") {
    need(2);
    used = 3;
    if (!periodic[0] || !periodic[1])
      error->all(FLERR, "create_membrane plane needs a box that is periodic in x and y");
    mesh = Membrane_NS::sheet(integer(1), integer(2), lattice, 0.5);
    centred = false;
    for (auto &p : mesh.points)
      for (int k = 0; k < 3; ++k) p[k] += domain->boxlo[k];
  } else if (shape == "cylinder") {
    need(4);
    used = 5;
    const std::string name = arg[4];
    axis = name == "x" ? 0 : name == "y" ? 1 : name == "z" ? 2 : -1;
    if (axis < 0) error->all(FLERR, "create_membrane cylinder axis {} is not x, y or z", name);
    if (!periodic[axis])
      error->all(FLERR, "create_membrane cylinder needs a box that is periodic in {}", name);
    mesh = Membrane_NS::tube(integer(1), integer(2), number(3), lattice, axis);
  } else if (shape == "torus") {
    need(4);
    mesh = Membrane_NS::torus(integer(1), integer(2), number(3), number(4));
    used = 5;
  } else if (shape == "file") {
    need(1);
    path = arg[1];
    used = 2;
    centred = false;
  } else
    error->all(FLERR,
               "Unknown create_membrane shape {}; known are: sphere, plane, cylinder, torus, file",
               shape);

  mesh.lattice = lattice;
  mesh.periodic = periodic;
  return used;
}

/* ---------------------------------------------------------------------- */

void CreateMembrane::parse_options(int narg, char **arg)
{
  auto need = [&](int iarg, int n) {
    if (iarg + n >= narg)
      utils::missing_cmd_args(FLERR, std::string("create_membrane ") + arg[iarg], error);
  };
  int iarg = 0;
  while (iarg < narg) {
    const std::string key = arg[iarg];
    need(iarg, 1);
    if (key == "centre" || key == "center") {
      need(iarg, 3);
      for (int k = 0; k < 3; ++k) centre[k] = utils::numeric(FLERR, arg[iarg + 1 + k], false, lmp);
      centred = true;
      iarg += 4;
    } else if (key == "scale") {
      need(iarg, 3);
      for (int k = 0; k < 3; ++k) {
        scale[k] = utils::numeric(FLERR, arg[iarg + 1 + k], false, lmp);
        if (scale[k] <= 0.0)
          error->all(FLERR, "create_membrane scale {} must be positive", arg[iarg + 1 + k]);
      }
      iarg += 4;
    } else if (key == "refine") {
      refine = utils::inumeric(FLERR, arg[iarg + 1], false, lmp);
      if (refine < 0 || refine > 10)
        error->all(FLERR, "create_membrane refine {} must be between 0 and 10", arg[iarg + 1]);
      iarg += 2;
    } else if (key == "flip") {
      flip = utils::logical(FLERR, arg[iarg + 1], false, lmp);
      iarg += 2;
    } else if (key == "interpolate") {
      interpolated = utils::logical(FLERR, arg[iarg + 1], false, lmp);
      iarg += 2;
    } else if (key == "molecule" || key == "mol") {
      molecule = utils::tnumeric(FLERR, arg[iarg + 1], false, lmp);
      if (molecule < 1)
        error->all(FLERR, "create_membrane molecule {} must be positive", arg[iarg + 1]);
      iarg += 2;
    } else if (key == "mass") {
      mass = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
      if (!(mass > 0.0))
        error->all(FLERR, "create_membrane mass {} must be positive", arg[iarg + 1]);
      iarg += 2;
    } else if (key == "face/type") {
      angle_type = utils::expand_type_int(FLERR, arg[iarg + 1], Atom::ANGLE, lmp);
      iarg += 2;
    } else
      error->all(
          FLERR,
          "Unknown create_membrane keyword {}; known are: center, scale, refine, interpolate, "
          "flip, molecule, mass, face/type",
          key);
  }
  if (angle_type < 1 || angle_type > atom->nangletypes)
    error->all(FLERR, "create_membrane face/type {} is not one of the {} angle types of the box",
               angle_type, atom->nangletypes);
  if (shape == "plane" && (scale[0] != 1.0 || scale[1] != 1.0))
    error->all(FLERR, "create_membrane plane spans the box: it cannot be scaled in x or y");
}

/* ----------------------------------------------------------------------
   read on one rank; all ranks fail together. The file knows nothing of scale: the box is shrunk by it.
------------------------------------------------------------------------- */

void CreateMembrane::read_file(TriangleMesh &mesh)
{
  const auto lattice = mesh.lattice;
  const auto periodic = mesh.periodic;
  std::string message;
  if (comm->me == 0) {
    try {
      Membrane_NS::PeriodicBox box;
      box.lattice = Eigen::Vector3d(scale).cwiseInverse().asDiagonal() * lattice;
      box.periodic = periodic;
      Membrane_NS::MeshFileReport had;
      mesh = Membrane_NS::read_mesh(path, box, had);
      report = had.summary();
    } catch (const MeshError &err) {
      message = err.what();
    } catch (const std::bad_alloc &) {
      message = "Mesh file " + path + ": not enough memory; use a coarser mesh";
    }
  }
  int sizes[3] = {(int) message.size(), (int) mesh.points.size(), (int) mesh.faces.size()};
  MPI_Bcast(sizes, 3, MPI_INT, 0, world);
  message.resize(sizes[0]);
  MPI_Bcast(message.data(), sizes[0], MPI_CHAR, 0, world);
  if (!message.empty()) throw MeshError(message);
  mesh.points.resize(sizes[1]);
  mesh.faces.resize(sizes[2]);
  MPI_Bcast(mesh.points.data(), 3 * sizes[1], MPI_DOUBLE, 0, world);
  MPI_Bcast(mesh.faces.data(), 3 * sizes[2], MPI_INT, 0, world);
  mesh.lattice = lattice;
  mesh.periodic = periodic;
}

/* ----------------------------------------------------------------------
   with flip, what is inside out is turned, and what has no inside; returns what stays inside out
------------------------------------------------------------------------- */

std::string CreateMembrane::turn(TriangleMesh &mesh)
{
  const Membrane_NS::Topology topology(mesh.points.size(), mesh.faces);
  const std::vector<double> volumes = Membrane_NS::enclosed_volumes(topology, mesh);
  if (flip) {
    std::vector<bool> which;
    for (double volume : volumes) which.push_back(volume < 0.0 || std::isnan(volume));
    const int turned = Membrane_NS::turn_components(mesh, topology, which);
    if (comm->me == 0)
      utils::logmesg(lmp, "Turned {} of {} faces by flip yes\n", turned, mesh.faces.size());
    return "";
  }
  int inside_out = 0, first = 0;
  for (int c = topology.num_components() - 1; c >= 0; --c)
    if (volumes[c] < 0.0) {
      ++inside_out;
      first = c;
    }
  if (inside_out == 0) return "";
  if (topology.num_components() == 1) return "the membrane is";
  return fmt::format("{} of its {} surfaces, the first of them number {}, {}", inside_out,
                     topology.num_components(), first + 1, inside_out == 1 ? "is" : "are");
}

/* ---------------------------------------------------------------------- */

void CreateMembrane::check_inside_box(const TriangleMesh &mesh)
{
  for (const auto &p : mesh.points) {
    const double d[3] = {p[0] - domain->boxlo[0], p[1] - domain->boxlo[1], p[2] - domain->boxlo[2]};
    const auto s = in_box_lengths(*domain, d);
    for (int k = 0; k < 3; ++k)
      if (domain->periodicity[k] && !(std::fabs(s[k]) < FARTHEST))
        error->all(FLERR, "create_membrane {}: control point ({:.6g}, {:.6g}, {:.6g}) is more than {} boxes away in {}; use "
                          "scale and center", shape, p[0], p[1], p[2], FARTHEST, "xyz"[k]);
  }
  for (const auto &p : mesh.points)
    if (const int k = beyond_fixed_side(*domain, p.data()); k >= 0)
      error->all(FLERR,
                 "create_membrane {}: control point ({:.6g}, {:.6g}, {:.6g}) is outside the box, "
                 "which is not periodic in {}; enlarge the box or use scale and center",
                 shape, p[0], p[1], p[2], "xyz"[k]);
}

/* ----------------------------------------------------------------------
   from here on an edge is the shortest of its periodic images: must be what was meant
------------------------------------------------------------------------- */

void CreateMembrane::check_edges(const TriangleMesh &mesh)
{
  if (shape != "sphere" && shape != "torus" && shape != "cylinder") return;
  const Eigen::Matrix3d inverse = mesh.lattice.inverse();
  for (const Face &face : mesh.faces)
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d s = inverse * (mesh.points[face[(i + 1) % 3]] - mesh.points[face[i]]);
      for (int k = 0; k < 3; ++k)
        if (domain->periodicity[k] && k != axis && std::fabs(s[k]) > 0.45)
          error->all(FLERR,
                     "create_membrane {}: an edge spans half the periodic box in {}; use a larger "
                     "box or a finer mesh",
                     shape, "xyz"[k]);
    }
}

/* ----------------------------------------------------------------------
   make room for n angles per atom in arrays that may already hold some
------------------------------------------------------------------------- */

template <typename T> static void widen(Memory *memory, T **&array, int rows, int used, int wide)
{
  T **wider;
  memory->create(wider, MAX(rows, 1), wide, "atom:angle");
  for (int i = 0; i < rows; ++i) {
    for (int m = 0; m < used; ++m) wider[i][m] = array[i][m];
    for (int m = used; m < wide; ++m) wider[i][m] = 0;
  }
  memory->destroy(array);
  array = wider;
}

void CreateMembrane::reserve_angles(int n)
{
  if (n <= atom->angle_per_atom) return;
  const int rows = atom->nmax, used = atom->angle_per_atom;
  atom->angle_per_atom = n;
  widen(memory, atom->angle_type, rows, used, n);
  widen(memory, atom->angle_atom1, rows, used, n);
  widen(memory, atom->angle_atom2, rows, used, n);
  widen(memory, atom->angle_atom3, rows, used, n);
  atom->avec->grow_pointers();
}

/* ----------------------------------------------------------------------
   each rank creates the points in its sub-domain
------------------------------------------------------------------------- */

void CreateMembrane::add_atoms(const TriangleMesh &mesh)
{
  check_inside_box(mesh);
  const int npoints = mesh.points.size();

  tagint most[2] = {0, 0}, maximum[2];
  for (int i = 0; i < atom->nlocal; ++i) {
    most[0] = MAX(most[0], atom->tag[i]);
    most[1] = MAX(most[1], atom->molecule[i]);
  }
  MPI_Allreduce(most, maximum, 2, MPI_LMP_TAGINT, MPI_MAX, world);
  const Membrane_NS::Topology topology(npoints, mesh.faces);
  first_molecule = molecule ? molecule : maximum[1] + 1;
  last_molecule = molecule ? molecule : maximum[1] + topology.num_components();
  const tagint first = maximum[0] + 1;
  if ((bigint) maximum[0] + npoints >= MAXTAGINT)
    error->all(FLERR, "create_membrane: too many atoms for their IDs; build LAMMPS with BIGBIG");

  // LAMMPS stores an angle with its middle atom, or with all three if newton_bond is off. Which
  // corner is the middle one is free: take the one that has fewest, for narrow arrays

  std::vector<std::vector<int>> stored(npoints);
  std::vector<Face> turned = mesh.faces;
  for (size_t f = 0; f < turned.size(); ++f) {
    Face &face = turned[f];
    if (!force->newton_bond) {
      for (int v : face) stored[v].push_back(f);
      continue;
    }
    int middle = 0;
    for (int k = 1; k < 3; ++k)
      if (stored[face[k]].size() < stored[face[middle]].size()) middle = k;
    std::rotate(face.begin(), face.begin() + (middle + 2) % 3, face.end());
    stored[face[1]].push_back(f);
  }
  size_t widest = 0;
  for (const auto &list : stored) widest = std::max(widest, list.size());

  if (atom->map_style != Atom::MAP_NONE) atom->map_clear();
  atom->nghost = 0;
  atom->avec->clear_bonus();
  reserve_angles(widest);

  // all images of a point go to the rank that owns the one inside the box

  const int nlocal_previous = atom->nlocal;
  if (comm->layout == Comm::LAYOUT_TILED) comm->coord2proc_setup();
  for (int v = 0; v < npoints; ++v) {
    double x[3] = {mesh.points[v][0], mesh.points[v][1], mesh.points[v][2]};
    imageint image = ((imageint) IMGMAX << IMG2BITS) | ((imageint) IMGMAX << IMGBITS) | IMGMAX;
    domain->remap(x, image);
    double s[3] = {x[0], x[1], x[2]};
    if (domain->triclinic) domain->x2lamda(x, s);
    int px, py, pz;
    if (comm->coord2proc(s, px, py, pz) != comm->me) continue;

    atom->avec->create_atom(type, x);
    const int i = atom->nlocal - 1;
    atom->tag[i] = first + v;
    atom->molecule[i] = molecule ? molecule : first_molecule + topology.component(v);
    atom->image[i] = image;
    atom->rmass[i] = mass;
    atom->num_angle[i] = stored[v].size();
    for (size_t m = 0; m < stored[v].size(); ++m) {
      const Face &face = turned[stored[v][m]];
      atom->angle_type[i][m] = angle_type;
      atom->angle_atom1[i][m] = first + face[0];
      atom->angle_atom2[i][m] = first + face[1];
      atom->angle_atom3[i][m] = first + face[2];
    }
  }
  atom->data_fix_compute_variable(nlocal_previous, atom->nlocal);

  const bigint before = atom->natoms;
  bigint nlocal = atom->nlocal;
  MPI_Allreduce(&nlocal, &atom->natoms, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (atom->natoms != before + npoints)
    error->all(FLERR, "create_membrane lost {} control points: is the box smaller than the mesh?",
               before + npoints - atom->natoms);
  atom->nangles += mesh.faces.size();
  atom->tag_check();
  if (atom->map_style != Atom::MAP_NONE) {
    atom->map_init();
    atom->map_set();
  }
}
