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

#ifndef LMP_MEMBRANE_SRD_SURFACE_LAYERS_H
#define LMP_MEMBRANE_SRD_SURFACE_LAYERS_H

#include <vector>

namespace Membrane_NS {

/** What the triangles that a cube of a SurfaceGrid knows have in common, so that one look tells of
    most points that they pass by all of them.

    Of the triangles that a cube knows, the nearest to its centre leads it. All corners known to the
    cubes that a triangle leads lie between two planes with its normal: the layer. */
class SurfaceLayers {
 public:
  /// Cube c knows the triangles list[start[c]] to list[start[c + 1] - 1]; lead: of each cube its
  /// leading triangle, or -1.
  void build(const class SurfaceImages &surface, const std::vector<int> &start,
             const std::vector<int> &list, std::vector<int> lead);
  /// The layers where the triangles are now.
  void measure(const SurfaceImages &surface);

  static constexpr int BLOCK = 512;
  /// Of the points numbered which[0] to which[n - 1], n <= BLOCK, leaves in front those that may
  /// come within `margin` of a triangle in that time, on straight lines, and returns how many they
  /// are. Three numbers a point; cubes: of each point, -1 beyond the grid; these know all triangles
  /// nearer than `listed`.
  int keep_passing(const double *x, const double *velocity, const int *cubes, double time,
                   double margin, double listed, int *which, int n) const;

  double memory_usage() const;

 private:
  std::vector<int> lead_;               // by cube, or -1
  std::vector<int> led_start_, led_;    // corners, by leading triangle
  struct Layer {
    double normal[3], lo, hi;
  };
  // beyond the grid, of a cube without triangles, and then by leading triangle
  enum { OPEN, EMPTY, LED };
  std::vector<Layer> layers_;
};

}    // namespace Membrane_NS

#endif
