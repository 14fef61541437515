/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

#ifdef DUMP_CLASS
// clang-format off
DumpStyle(membrane/image,DumpMembraneImage);
// clang-format on
#else

#ifndef LMP_DUMP_MEMBRANE_IMAGE_H
#define LMP_DUMP_MEMBRANE_IMAGE_H

#include "dump_image.h"
#include "membrane_picture.h"
#include "membrane_tessellation.h"
#include "mesh_local.h"
#include "mesh_scene.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/** dump image with the limit surface of the membranes, smoothly shaded.

    Image can draw triangles of one color and one normal. It is given one for each pixel that the
    surface covers, just large enough to cover it, in the tangent plane of the surface there. */
class DumpMembraneImage : public DumpImage {
 public:
  DumpMembraneImage(class LAMMPS *, int, char **);
  void write() override;

 protected:
  void init_style() override;
  int modify_param(int, char **) override;
  int count() override;

 private:
  enum class Coloring { MEAN_CURVATURE, GAUSSIAN_CURVATURE, TYPE, MOLECULE, LIPID } coloring;
  int leaflet;          // of the lipid, 0 outer, 1 inner
  std::string lipid;
  std::vector<double> fractions;    // of it, by face
  bool draw_points;     // control points are drawn like other atoms
  bool in_one_piece;    // closed membranes are, beyond the box if need be
  bool own_map;         // the user's color map instead of ours
  bool auto_range;
  double lo, hi;    // values at the ends of the color map
  bool range_reported;
  int subdivide;    // 0: as fine as the picture

  LocalMesh mesh;
  Membrane_NS::Camera camera;
  std::unique_ptr<Membrane_NS::FaceTessellation> tessellation;

  DumpMembraneImage(class LAMMPS *, std::vector<char *>);
  void write_picture();
  void set_camera();

  // === One picture

  void choose_range(MeshScene &);
  void draw_surface();
  bool has_values() const { return coloring != Coloring::TYPE && coloring != Coloring::MOLECULE; }
  void find_lipids();
  double value(int face, const Membrane_NS::LimitPoint &) const;
  Eigen::Vector3d color(const MeshScene &, int face, const Membrane_NS::LimitPoint &,
                        int point) const;
  void draw_triangle(const std::array<Membrane_NS::Corner, 3> &,
                     const std::array<bool, 3> &cut_along, class Region *) const;
  void draw_pixel(const Membrane_NS::Fragment &) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
