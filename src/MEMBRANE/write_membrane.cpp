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

#include "write_membrane.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hd_bound.h"
#include "mesh_distributed.h"
#include "mesh_gather.h"
#include "mesh_lipid_places.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using Membrane_NS::Face;
using Membrane_NS::FaceTessellation;
using Membrane_NS::MeshError;
using Membrane_NS::TessellatedSurface;
using Membrane_NS::Topology;
using Membrane_NS::TriangleMesh;

/* ---------------------------------------------------------------------- */

WriteMembrane::WriteMembrane(LAMMPS *lmp) :
    Command(lmp), format(Format::VTP), subdivide(4), fields(true), domains(false)
{
}

/* ---------------------------------------------------------------------- */

void WriteMembrane::command(int narg, char **arg)
{
  DistributedMesh &mesh = DistributedMesh::of(lmp, "write_membrane");
  parse(narg, arg);

  // collective, and it leaves atoms and ghosts as they are: the next run does not notice

  mesh.update();
  if (mesh.topology().num_faces() == 0)
    error->all(FLERR, "write_membrane finds no membrane: use create_membrane or read_data");
  for (tagint molecule : chosen)
    if (std::find(mesh.molecules().begin(), mesh.molecules().end(), molecule) ==
        mesh.molecules().end())
      error->all(
          FLERR,
          "write_membrane membrane {} does not exist; molecule IDs of membranes are {} to {}",
          molecule, mesh.molecules().front(), mesh.molecules().back());

  gather_vertices(mesh);

  // every rank has the whole mesh: one writes, all fail together

  std::string message;
  bigint size[2] = {0, 0};
  if (comm->me == 0) {
    try {
      const Surface what = surface(mesh);
      size[0] = what.mesh.points.size();
      size[1] = what.mesh.faces.size();
      write(what);
    } catch (const MeshError &err) {
      message = err.what();
    } catch (const std::bad_alloc &) {
      message = "not enough memory; use a smaller subdivide";
    }
  }
  int length = message.size();
  MPI_Bcast(&length, 1, MPI_INT, 0, world);
  message.resize(length);
  MPI_Bcast(message.data(), length, MPI_CHAR, 0, world);
  if (!message.empty()) error->all(FLERR, "write_membrane: {}", message);

  if (comm->me == 0)
    utils::logmesg(lmp, "Wrote {} of the membrane to {}: {} points, {} triangles\n",
                   subdivide == 0 ? "the control mesh" : "the limit surface", path, size[0],
                   size[1]);
}

/* ---------------------------------------------------------------------- */

void WriteMembrane::parse(int narg, char **arg)
{
  if (narg < 1) utils::missing_cmd_args(FLERR, "write_membrane", error);
  path = utils::star_subst(arg[0], update->ntimestep, 0);
  parse_format();

  for (int iarg = 1, used = 2; iarg < narg; iarg += used) {
    const std::string key = arg[iarg];
    if (key != "subdivide" && key != "membrane" && key != "fields" && key != "inclusions" &&
        key != "domains")
      error->all(FLERR,
                 "Unknown write_membrane keyword {}; known are: subdivide, membrane, fields, "
                 "inclusions, domains",
                 key);
    used = key == "inclusions" ? 3 : 2;
    if (iarg + used > narg) utils::missing_cmd_args(FLERR, "write_membrane " + key, error);
    if (used == 3 || key == "domains")
      if (format != Format::TSI)
        error->all(FLERR, "write_membrane: only a file in TSI format has a place for {}", key);

    if (key == "subdivide") {
      subdivide = utils::inumeric(FLERR, arg[iarg + 1], false, lmp);
      if (subdivide < 0 || subdivide > FaceTessellation::MOST)
        error->all(FLERR, "write_membrane subdivide {} must be between 0 and {}", arg[iarg + 1],
                   (int) FaceTessellation::MOST);
    } else if (key == "membrane") {
      chosen.push_back(utils::tnumeric(FLERR, arg[iarg + 1], false, lmp));
    } else if (key == "domains") {
      domains = utils::logical(FLERR, arg[iarg + 1], false, lmp);
    } else if (key == "inclusions") {
      const int type = utils::inumeric(FLERR, arg[iarg + 2], false, lmp);
      if (type < 0) error->all(FLERR, "write_membrane inclusions {} must not be negative", type);
      inclusions.emplace_back(arg[iarg + 1], type);
    } else {
      fields = utils::logical(FLERR, arg[iarg + 1], false, lmp);
      if (fields && !format_has_fields())
        error->all(FLERR,
                   "write_membrane: a file in {} format has no place for fields; use the "
                   "extension ply or vtp",
                   format == Format::OFF ? "OFF" : "TSI");
    }
  }
}

void WriteMembrane::parse_format()
{
  const size_t dot = path.find_last_of("./");
  const std::string extension =
      dot == std::string::npos || path[dot] == '/' ? "" : utils::lowercase(path.substr(dot + 1));
  if (extension == "off")
    format = Format::OFF;
  else if (extension == "ply")
    format = Format::PLY;
  else if (extension == "tsi")
    format = Format::TSI;
  else if (extension == "vtp")
    format = Format::VTP;
  else
    error->all(FLERR,
               "write_membrane file {} must have the extension off, ply, tsi or vtp, which names "
               "the format",
               path);
}

/* ----------------------------------------------------------------------
   the chosen membranes, with vertices in the order of atom IDs; labels are their molecule IDs
------------------------------------------------------------------------- */

TriangleMesh WriteMembrane::control_mesh(const DistributedMesh &mesh, std::vector<double> &labels,
                                         std::vector<int> &vertices, std::vector<int> &faces) const
{
  const Topology &topology = mesh.topology();
  const TriangleMesh all = mesh.triangle_mesh();
  TriangleMesh part;
  part.lattice = all.lattice;
  part.periodic = all.periodic;
  std::vector<int> number(topology.num_vertices(), -1);
  for (int v = 0; v < topology.num_vertices(); ++v) {
    const tagint molecule = mesh.molecule(topology.component(v));
    if (!chosen.empty() && std::find(chosen.begin(), chosen.end(), molecule) == chosen.end())
      continue;
    number[v] = part.points.size();
    part.points.push_back(all.points[v]);
    labels.push_back(molecule);
    vertices.push_back(v);
  }
  for (size_t f = 0; f < all.faces.size(); ++f) {
    const Face &face = all.faces[f];
    if (number[face[0]] < 0) continue;
    part.faces.push_back({number[face[0]], number[face[1]], number[face[2]]});
    faces.push_back(static_cast<int>(f));
  }
  return part;
}

/* ---------------------------------------------------------------------- */

WriteMembrane::Surface WriteMembrane::surface(const DistributedMesh &mesh) const
{
  std::vector<double> labels;
  std::vector<int> vertices, faces;
  const TriangleMesh control = control_mesh(mesh, labels, vertices, faces);
  const Topology topology(control.points.size(), control.faces);

  // n = 1 has the vertices and faces of the control mesh, and its curvatures are those of the limit
  // surface at the control points

  const int n = MAX(1, subdivide);
  const double triangles = double(topology.num_faces()) * n * n;
  if (triangles > MAXSMALLINT)
    throw MeshError(fmt::format("{:.3g} triangles are more than a file takes; use a smaller "
                                "subdivide",
                                triangles));
  TessellatedSurface cut = Membrane_NS::tessellate(topology, control, n);
  if (subdivide == 0) cut.mesh.points = control.points;

  // what continues through the box is written within it

  const auto continues = continuing_directions(topology, control);
  const Eigen::Matrix3d inverse = control.lattice.inverse();
  const Eigen::Vector3d origin(domain->boxlo);
  std::vector<double> membrane;
  for (size_t p = 0; p < cut.mesh.points.size(); ++p) {
    const int v = p < control.points.size() ? p : topology.face(cut.face[p])[0];
    const Eigen::Vector3d fraction = inverse * (cut.mesh.points[p] - origin);
    for (int k = 0; k < 3; ++k)
      if (continues[topology.component(v)][k])
        cut.mesh.points[p] -= std::floor(fraction[k]) * control.lattice.col(k);
    membrane.push_back(labels[v]);
  }

  Surface what;
  if (format == Format::TSI) set_vertices(topology, cut, vertices, what);
  what.mesh = std::move(cut.mesh);
  if (fields && format_has_fields()) {
    what.fields = {{"mean_curvature", std::move(cut.mean_curvature)},
                   {"gaussian_curvature", std::move(cut.gaussian_curvature)},
                   {"membrane", std::move(membrane)}};
    add_lipids(mesh, topology, faces, n, what.fields);
  }

  // what has a box that begins at 0

  if (format == Format::TSI) {
    for (auto &point : what.mesh.points) point -= origin;
    return what;
  }

  // a surface is to look at; the faces of a control mesh are to find their images in the box again

  if (subdivide > 0) {
    Membrane_NS::MeshDrawing drawing = Membrane_NS::cut_open(what.mesh);
    what.mesh = std::move(drawing.mesh);
    what.mesh.periodic = {false, false, false};
    for (auto &field : what.fields) {
      std::vector<double> values;
      for (int p : drawing.source) values.push_back(field.second[p]);
      field.second = std::move(values);
    }
  }
  return what;
}

/* ----------------------------------------------------------------------
   fractions of kinds of single lipids, if there are any: at each point those of the lipids of all faces it lies on.
   `of` are the faces of the whole mesh.
------------------------------------------------------------------------- */

void WriteMembrane::add_lipids(const DistributedMesh &mesh, const Topology &topology, const std::vector<int> &of, int n,
                               Membrane_NS::PointFields &into) const
{
  const LipidPlaces *places = LipidPlaces::on(mesh, modify);
  if (!places) return;
  const Membrane_NS::TessellationNumbering numbering(topology, n);
  const int nkinds = static_cast<int>(places->kinds.size()), npoints = numbering.num_points();
  for (int leaflet = 0; leaflet < 2; ++leaflet) {
    std::vector<std::vector<double>> number(nkinds, std::vector<double>(npoints, 0.0));
    std::vector<double> all(npoints, 0.0), total(nkinds, 0.0);
    std::vector<int> here(nkinds);
    for (int f = 0; f < topology.num_faces(); ++f) {
      std::fill(here.begin(), here.end(), 0);
      places->lipids->count(leaflet, of[f], here.data());
      for (int k = 0; k < nkinds; ++k) total[k] += here[k];
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i + j <= n; ++i) {
          const int p = numbering.number(f, i, j);
          all[p] += places->lipids->size(leaflet, of[f]);
          for (int k = 0; k < nkinds; ++k) number[k][p] += here[k];
        }
    }
    for (int k = 0; k < nkinds; ++k) {
      if (total[k] == 0.0) continue;
      for (int p = 0; p < npoints; ++p)
        if (all[p] > 0.0) number[k][p] /= all[p];
      into.emplace_back((leaflet == 0 ? "outer_" : "inner_") + places->kinds[k].name, std::move(number[k]));
    }
  }
}

/* ----------------------------------------------------------------------
   collective: types of control points, and where bound particles are
------------------------------------------------------------------------- */

void WriteMembrane::gather_vertices(const DistributedMesh &mesh)
{
  if (domains) {
    std::vector<int> mine(mesh.topology().num_vertices(), 0);
    types.resize(mine.size());
    for (int i = 0; i < atom->nlocal; ++i)
      if (const int v = mesh.vertex(atom->tag[i]); v >= 0) mine[v] = atom->type[i];
    MPI_Allreduce(mine.data(), types.data(), static_cast<int>(mine.size()), MPI_INT, MPI_MAX, world);
  }
  for (const auto &[id, type] : inclusions) {
    const FixHDBound *bind = FixHDBound::named(lmp, id, "write_membrane");
    std::vector<Bound> mine;
    for (int i = 0; i < atom->nlocal; ++i)
      if (atom->mask[i] & bind->groupbit)
        mine.push_back({atom->tag[i], type, {atom->x[i][0], atom->x[i][1], atom->x[i][2]}});
    const std::vector<Bound> all = gather_all(mine, world);
    bound.insert(bound.end(), all.begin(), all.end());
  }
  std::sort(bound.begin(), bound.end(), [](const Bound &a, const Bound &b) { return a.id < b.id; });
}

/* ----------------------------------------------------------------------
   the domain of a point is the type of the nearest corner of its face, less 1; a bound particle becomes an
   inclusion of the nearest vertex that has none. `of` are the vertices of the whole mesh.
------------------------------------------------------------------------- */

void WriteMembrane::set_vertices(const Topology &topology, const TessellatedSurface &cut, const std::vector<int> &of,
                                 Surface &what) const
{
  const auto &points = cut.mesh.points;
  if (domains)
    for (size_t p = 0; p < points.size(); ++p) {
      int nearest = p < of.size() ? p : -1;
      double least = INFINITY;
      if (nearest < 0)
        for (int v : topology.face(cut.face[p]))
          if (const double d = cut.mesh.nearest_image(points[v] - points[p]).norm(); d < least) {
            least = d;
            nearest = v;
          }
      what.vertices.domains.push_back(types[of[nearest]] - 1);
    }
  std::vector<char> taken(points.size(), 0);
  for (const Bound &particle : bound) {
    int nearest = -1;
    double least = INFINITY;
    for (size_t p = 0; p < points.size(); ++p) {
      if (taken[p]) continue;
      const double d = cut.mesh.nearest_image(points[p] - Eigen::Vector3d(particle.x)).squaredNorm();
      if (d >= least) continue;
      least = d;
      nearest = p;
    }
    if (nearest < 0)
      throw MeshError(fmt::format("there are {} inclusions and {} vertices, which have one at most; use a larger subdivide",
                                  bound.size(), points.size()));
    taken[nearest] = 1;
    what.vertices.inclusions.push_back({particle.type, nearest});
  }
}

/* ---------------------------------------------------------------------- */

void WriteMembrane::write(const Surface &what) const
{
  switch (format) {
    case Format::OFF:
      Membrane_NS::write_off(path, what.mesh);
      break;
    case Format::PLY:
      Membrane_NS::write_ply(path, what.mesh, what.fields);
      break;
    case Format::TSI:
      Membrane_NS::write_tsi(path, what.mesh, {}, what.vertices);
      break;
    case Format::VTP:
      Membrane_NS::write_vtp(path, what.mesh, what.fields);
      break;
  }
}
