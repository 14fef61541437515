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

#include "dump_membrane_image.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "image.h"
#include "memory.h"
#include "mesh_box.h"
#include "mesh_lipid_places.h"
#include "modify.h"
#include "output.h"
#include "platform.h"
#include "region.h"
#include "thermo.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using Membrane_NS::Camera;
using Membrane_NS::Corner;
using Membrane_NS::Face;
using Membrane_NS::FaceTessellation;
using Membrane_NS::Fragment;
using Membrane_NS::LimitPoint;

static constexpr int SURFACE_MAP = 1;             // Image's map for grid cells, which are not drawn
static constexpr double TRIANGLE_PIXELS = 4.0;    // side of a triangle; shading varies within it
static constexpr int FINEST = 64;

// lights that add up to one: colors stay what they are where the surface faces the light
static constexpr double AMBIENT_LIGHT = 0.4, KEY_LIGHT = 0.45, FILL_LIGHT = 0.25;

static constexpr double WIDTH = 2.5;          // of the range of colors, in standard deviations
static constexpr double LEAST_WIDTH = 0.5;    // and at least this part of the mean

/* ----------------------------------------------------------------------
   defaults that suit a surface, for what the user does not set. They go last, so that errors point
   at the right argument. DumpCustom accepts keywords for a style named image only
------------------------------------------------------------------------- */

static std::vector<char *> with_defaults(int narg, char **arg)
{
  static constexpr int REQUIRED = 7;    // ID group style N file color diameter
  static const std::vector<std::vector<const char *>> defaults = {
      {"fsaa", "yes"}, {"zoom", "1.25"}, {"box", "yes", "0.004"}, {"shiny", "0.3"}};
  std::vector<char *> args(arg, arg + narg);
  args[2] = const_cast<char *>("image");
  if (narg < REQUIRED) return args;
  for (const auto &setting : defaults) {
    const bool is_set = std::any_of(arg + REQUIRED, arg + narg, [&](const char *word) {
      return strcmp(word, setting[0]) == 0;
    });
    if (is_set) continue;
    for (const char *word : setting) args.push_back(const_cast<char *>(word));
  }
  return args;
}

DumpMembraneImage::DumpMembraneImage(LAMMPS *lmp, int narg, char **arg) :
    DumpMembraneImage(lmp, with_defaults(narg, arg))
{
}

DumpMembraneImage::DumpMembraneImage(LAMMPS *lmp, std::vector<char *> args) :
    DumpImage(lmp, static_cast<int>(args.size()), args.data()), coloring(Coloring::MEAN_CURVATURE), leaflet(0),
    draw_points(false), in_one_piece(true), own_map(false), auto_range(true), lo(0.0), hi(1.0),
    range_reported(false), subdivide(0), mesh(lmp, "Dump membrane/image")
{
  mesh.require();
  delete[] style;
  style = utils::strdup("membrane/image");

  if (gridflag) error->all(FLERR, "Dump membrane/image does not draw grid cells: use dump image");
  for (size_t i = ioptional; i + 1 < args.size(); ++i)
    if (strcmp(args[i], "bond") == 0 && utils::strmatch(args[i + 1], "^c_"))
      error->all(FLERR,
                 "Dump membrane/image does not color bonds by a compute: use dump image for these");
  if (utils::strmatch(filename, "\\.[tT][gG][aA]"))
    error->all(FLERR, "Dump membrane/image writes JPEG, PNG and PPM files, not {}", filename);

  for (int &component : image->background) component = 255;
  for (int k = 0; k < 3; ++k) {
    image->ambientColor[k] = AMBIENT_LIGHT;
    image->keyLightColor[k] = KEY_LIGHT;
    image->fillLightColor[k] = FILL_LIGHT;
  }
  image->boxcolor = image->color2rgb("gray");
  set_camera();
}

/* ---------------------------------------------------------------------- */

void DumpMembraneImage::init_style()
{
  // write_dump allows a name without * for dump image only

  if (strcmp(id, "WRITE_DUMP") == 0) multifile_override = 1;
  DumpImage::init_style();
}

/* ---------------------------------------------------------------------- */

int DumpMembraneImage::modify_param(int narg, char **arg)
{
  const std::string key = arg[0];
  auto need = [&](int n) {
    if (narg < n + 1) utils::missing_cmd_args(FLERR, "dump_modify " + key, error);
  };

  if (key == "surface") {
    need(1);
    const std::string what = arg[1];
    if (what == "H")
      coloring = Coloring::MEAN_CURVATURE;
    else if (what == "K")
      coloring = Coloring::GAUSSIAN_CURVATURE;
    else if (what == "type")
      coloring = Coloring::TYPE;
    else if (what == "molecule")
      coloring = Coloring::MOLECULE;
    else if (what == "outer" || what == "inner") {
      need(2);
      coloring = Coloring::LIPID;
      leaflet = what == "inner";
      lipid = arg[2];
    } else
      error->all(FLERR, "dump_modify surface {} is not one of H, K, type, molecule, outer, inner", what);
    range_reported = false;
    return coloring == Coloring::LIPID ? 3 : 2;
  }
  if (key == "range") {
    need(1);
    range_reported = false;
    auto_range = strcmp(arg[1], "auto") == 0;
    if (auto_range) return 2;
    need(2);
    lo = utils::numeric(FLERR, arg[1], false, lmp);
    hi = utils::numeric(FLERR, arg[2], false, lmp);
    if (!(lo < hi))
      error->all(FLERR, "dump_modify range {} {}: the second value must be the larger", arg[1],
                 arg[2]);
    return 3;
  }
  if (key == "subdivide") {
    need(1);
    subdivide = 0;
    if (strcmp(arg[1], "auto") != 0) {
      subdivide = utils::inumeric(FLERR, arg[1], false, lmp);
      if (subdivide < 1 || subdivide > FaceTessellation::MOST)
        error->all(FLERR, "dump_modify subdivide {} must be auto or between 1 and {}", arg[1],
                   (int) FaceTessellation::MOST);
    }
    return 2;
  }
  if (key == "points") {
    need(1);
    draw_points = utils::logical(FLERR, arg[1], false, lmp);
    return 2;
  }
  if (key == "whole") {
    need(1);
    in_one_piece = utils::logical(FLERR, arg[1], false, lmp);
    return 2;
  }
  if (key == "smap") {

    // the syntax is that of amap and gmap

    std::vector<char *> args(arg, arg + narg);
    char gmap[] = "gmap";
    args[0] = gmap;
    own_map = true;
    return DumpImage::modify_param(narg, args.data());
  }
  return DumpImage::modify_param(narg, arg);
}

/* ----------------------------------------------------------------------
   atoms to draw as spheres
------------------------------------------------------------------------- */

int DumpMembraneImage::count()
{
  DumpImage::count();
  if (draw_points) return nchoose;
  int kept = 0;
  for (int k = 0; k < nchoose; ++k) {
    const int i = clist[k];
    choose[i] = mesh->vertex(atom->tag[i]) < 0;
    if (choose[i]) clist[kept++] = i;
  }
  return nchoose = kept;
}

/* ----------------------------------------------------------------------
   as DumpImage::write(), plus the surface
------------------------------------------------------------------------- */

void DumpMembraneImage::write()
{
  mesh.init();
  openfile();

  box_bounds();
  if (cflag) box_center();
  if (viewflag) {
    view_params();
    set_camera();
  }

  nme = count();
  if (nme > maxbuf) {
    maxbuf = nme;
    memory->destroy(buf);
    memory->create(buf, maxbuf * size_one, "dump:buf");
  }
  pack(nullptr);

  if (image->map_dynamic(0)) {
    double mine[2] = {-HUGE_VAL, -HUGE_VAL}, all[2];
    for (int i = 0; i < nchoose; ++i) {
      mine[0] = MAX(mine[0], -buf[i * size_one]);
      mine[1] = MAX(mine[1], buf[i * size_one]);
    }
    MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_MAX, world);
    if (-all[0] <= all[1] && image->map_minmax(0, -all[0], all[1]))
      error->all(FLERR, "Invalid atom color map min/max values");
  }

  image->clear();
  create_image();
  draw_surface();
  image->merge();
  if (me == 0) write_picture();
}

// newer LAMMPS has a file pointer that closes the file when it is set

template <typename Pointer> static void close_file(Pointer &fp, int /*compressed*/)
{
  fp = nullptr;
}

[[maybe_unused]] static void close_file(FILE *&fp, int compressed)
{
  if (compressed)
    platform::pclose(fp);
  else
    fclose(fp);
  fp = nullptr;
}

void DumpMembraneImage::write_picture()
{
  if (filetype == JPG)
    image->write_JPG(fp);
  else if (filetype == PNG)
    image->write_PNG(fp);
  else
    image->write_PPM(fp);
  if (!multifile) return;
  close_file(fp, compressed);
  output->thermo->set_image_fname(utils::star_subst(filename, update->ntimestep, padflag));
}

/* ----------------------------------------------------------------------
   where Image::view_params() put the camera
------------------------------------------------------------------------- */

void DumpMembraneImage::set_camera()
{
  camera = Membrane_NS::camera_from(image->theta, image->phi, Vector3d(image->up));
  camera.width = image->width;
  camera.height = image->height;
  const double longest = MAX(boxxhi - boxxlo, MAX(boxyhi - boxylo, boxzhi - boxzlo));
  camera.pixel = 2.0 * longest / image->height / image->zoom;
}

/* ---------------------------------------------------------------------- */

double DumpMembraneImage::value(int face, const LimitPoint &point) const
{
  if (coloring == Coloring::LIPID) return fractions[face];
  return coloring == Coloring::GAUSSIAN_CURVATURE ? point.gaussian_curvature : point.mean_curvature;
}

void DumpMembraneImage::find_lipids()
{
  if (coloring != Coloring::LIPID) return;
  const LipidPlaces *places = LipidPlaces::on(*mesh, modify);
  if (!places)
    error->all(FLERR, "dump_modify surface {}: no single lipids are on faces; use fix hd/lipids, and run", leaflet ? "inner" : "outer");
  const int kind = places->kind(lipid);
  if (kind < 0) error->all(FLERR, "dump_modify surface {}: no membrane has the lipid {}", leaflet ? "inner" : "outer", lipid);
  fractions.resize(places->lipids->num_faces());
  for (int f = 0; f < places->lipids->num_faces(); ++f)
    fractions[f] = places->count(leaflet, f, kind) / MAX(1.0, places->lipids->size(leaflet, f));
}

/* ----------------------------------------------------------------------
   colors around the mean over the surface: a few sharp bends do not use them all up
------------------------------------------------------------------------- */

void DumpMembraneImage::choose_range(MeshScene &scene)
{
  if (!has_values()) return;

  if (auto_range && coloring == Coloring::LIPID) {
    lo = 0.0;
    hi = 1.0;
  } else if (auto_range) {
    double mean, deviation;
    if (!scene.statistics(
            [this](const LimitPoint &p) {
              return value(-1, p);
            },
            mean, deviation))
      return;
    double width = MAX(WIDTH * deviation, LEAST_WIDTH * std::fabs(mean));
    if (width == 0.0) width = 1.0;
    lo = mean - width;
    hi = mean + width;
  }

  if (own_map && image->map_dynamic(SURFACE_MAP) && image->map_minmax(SURFACE_MAP, lo, hi))
    error->all(FLERR, "dump_modify smap has values outside the range {:.6g} to {:.6g}", lo, hi);
  if (me == 0 && !range_reported && !(own_map && !image->map_dynamic(SURFACE_MAP)))
    utils::logmesg(lmp, "Dump {} colors membranes by {} from {:.6g} to {:.6g}\n", id,
                   coloring == Coloring::MEAN_CURVATURE           ? "mean curvature"
                       : coloring == Coloring::GAUSSIAN_CURVATURE ? "Gaussian curvature"
                                                                  : "the part of " + lipid,
                   lo, hi);
  range_reported = true;
}

/* ---------------------------------------------------------------------- */

Vector3d DumpMembraneImage::color(const MeshScene &scene, int f, const LimitPoint &point,
                                  int p) const
{
  const Face &face = mesh->topology().face(f);
  switch (coloring) {
    case Coloring::MOLECULE:
      return Membrane_NS::distinct_color(mesh->membrane(mesh->topology().component(face[0])));
    case Coloring::TYPE:
      return Vector3d(colortype[scene.type(face[tessellation->nearest_corner(p)])]);
    default:
      if (own_map) return Vector3d(image->map_value2color(SURFACE_MAP, value(f, point)));
      return Membrane_NS::diverging_color((value(f, point) - lo) / (hi - lo));
  }
}

/* ---------------------------------------------------------------------- */

void DumpMembraneImage::draw_surface()
{
  MeshScene scene(lmp, *mesh, groupbit, in_one_piece);
  find_lipids();
  choose_range(scene);

  int n = subdivide;
  if (n == 0) {
    const double sides = std::ceil(mesh->longest_edge() / (TRIANGLE_PIXELS * camera.pixel));
    n = static_cast<int>(MIN(MAX(sides, 2.0), FINEST));
  }
  if (!tessellation || tessellation->subdivision() != n)
    tessellation = std::make_unique<FaceTessellation>(n);

  Region *region = idregion ? domain->get_region_by_id(idregion) : nullptr;
  if (region) region->prematch();
  camera.centre = {image->xctr, image->yctr, image->zctr};

  std::vector<LimitPoint> points;
  std::vector<Corner> corners;
  for (int f : scene.faces()) {
    scene.evaluate(f, *tessellation, points);
    corners.clear();
    for (const LimitPoint &point : points)
      corners.push_back(
          {point.position, point.normal, color(scene, f, point, static_cast<int>(corners.size()))});
    for (const Face &t : tessellation->triangles())
      draw_triangle({corners[t[0]], corners[t[1]], corners[t[2]]}, scene.cut_along(f), region);
  }
}

/* ----------------------------------------------------------------------
   all images of a triangle that are in the box, cut off at its sides
------------------------------------------------------------------------- */

void DumpMembraneImage::draw_triangle(const std::array<Corner, 3> &triangle,
                                      const std::array<bool, 3> &cut_along, Region *region) const
{
  const Eigen::Matrix3d box = box_vectors(*domain);
  const Vector3d origin(domain->boxlo);
  auto fractions = [&](const Vector3d &r) {
    const Vector3d d = r - origin;
    return Vector3d(in_box_lengths(*domain, d.data()).data());
  };
  int first[3] = {0, 0, 0}, last[3] = {0, 0, 0};
  Vector3d low = fractions(triangle[0].position), high = low;
  for (int c = 1; c < 3; ++c) {
    const Vector3d s = fractions(triangle[c].position);
    low = low.cwiseMin(s);
    high = high.cwiseMax(s);
  }
  for (int k = 0; k < 3; ++k)
    if (cut_along[k]) {
      first[k] = static_cast<int>(std::floor(low[k]));
      last[k] = static_cast<int>(std::floor(high[k]));
    }

  for (int i = first[0]; i <= last[0]; ++i)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int k = first[2]; k <= last[2]; ++k) {
        const Vector3d shift = box * Vector3d(i, j, k);
        std::array<Corner, 3> moved = triangle;
        for (Corner &corner : moved) corner.position -= shift;
        rasterize(camera, moved, [&](const Fragment &fragment) {
          const Vector3d &r = fragment.position, s = fractions(r);
          for (int m = 0; m < 3; ++m)
            if (last[m] > first[m] && (s[m] < 0.0 || s[m] > 1.0)) return;
          if (!region || region->match(r[0], r[1], r[2])) draw_pixel(fragment);
        });
      }
}

/* ----------------------------------------------------------------------
   a triangle about one pixel's centre and no other's, in the tangent plane. The first corner is
   lower left of the centre since Image measures the pixels to draw from there
------------------------------------------------------------------------- */

void DumpMembraneImage::draw_pixel(const Fragment &fragment) const
{
  static constexpr double NEAR = -0.5, FAR = 1.3;
  const Vector3d &n = fragment.normal;
  auto corner = [&](double x, double y) -> Vector3d {
    const Vector3d in_picture = camera.pixel * (x * camera.right + y * camera.up);
    return fragment.position + in_picture -
        n.dot(in_picture) / n.dot(camera.toward) * camera.toward;
  };
  Vector3d a = corner(NEAR, NEAR), b = corner(NEAR, FAR), c = corner(FAR, NEAR);
  Vector3d rgb = fragment.color;
  image->draw_triangle(a.data(), b.data(), c.data(), rgb.data());
}
