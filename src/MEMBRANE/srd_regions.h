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

#ifndef LMP_SRD_REGIONS_H
#define LMP_SRD_REGIONS_H

#include "membrane_side.h"
#include "pointers.h"
#include "srd_surface_motion.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/** Which region of space, of those that membranes bound, each solvent atom belongs to.

    A region is where an atom has certain levels (see SurfaceSide) with respect to all surfaces.
    Few of them occur, so an atom carries the number of its region, an int; what the numbers mean
    is the same on all ranks. Regions are found from positions at setup, carried along with the
    atoms, and compared with positions when asked: an atom that is elsewhere has crossed. */
class SurfaceRegions : protected Pointers {
 public:
  /// `user` is named in errors.
  SurfaceRegions(class LAMMPS *, SurfaceMotion &, std::string user);
  ~SurfaceRegions() override;

  /// Collective, from setup(): the region of all solvent, from its position.
  void assign(const class SRDSolvent &);

  // === What an atom may meet

  /// +1 if an atom of this region is in front (see normals) of a face that is moved by `lattice`
  /// box vectors from where the surface is in one piece; image: the atom's image flags.
  int side(int region, imageint image, int component, const std::array<int, 3> &lattice) const
  {
    const Membrane_NS::SurfaceSide &s = sides[component];
    const int n = lattice[s.axis()] + flag(image, s.axis());
    return s.side(levels[region * num_surfaces + surface_of[component]], n);
  }
  /// Whether atoms of a region are inside of a closed surface.
  bool is_inside(int region) const { return inside[region] != 0; }
  /** Parities of the regions of all solvent, by local atom: even and odd tell the two sides of a
      surface apart wherever the two are close. In the frame of the box: an atom that is wrapped
      changes its parity if flips() says so. */
  void find_parities(const class SRDSolvent &, int *parity) const;
  bool flips(int direction) const { return flip[direction] != 0; }
  /** Collective, after assign(): the parts of the box whose parity is even and odd, by 30,000 places: good
      to two parts in a thousand. The same on any number of ranks. */
  std::array<double, 2> volumes() const;

  /// By local atom; grow_arrays() and the like of a fix.
  int *region;
  void grow(int nmax);

  // === Check. Both need the whole surface, for which all ranks send all of it to all.

  /// An atom that is not where it belongs.
  struct Crossing {
    int atom, component, level;    ///< the level it should have
  };
  /// Collective: atoms of this rank whose positions contradict their regions.
  std::vector<Crossing> find_crossings(const class SRDSolvent &);
  /// After that: the vertices of the surface.
  const std::vector<Membrane_NS::SurfaceVertex> &places() const { return vertices; }
  /// After find_crossings(): whether a position is in a region.
  bool belongs(const double *x, imageint image, int region) const;

  /// Frees the memory for where the surface was: until the next check no position is looked up.
  void forget_places();

  double memory_usage() const;

 private:
  SurfaceMotion &motion;
  std::string user;
  std::vector<Membrane_NS::SurfaceVertex> vertices;
  int num_surfaces;
  std::vector<int> surface_of;    // of a component: its place among those of the group
  std::vector<Membrane_NS::SurfaceSide> sides;    // by component
  std::vector<int> levels;                        // [region][surface]
  std::vector<char> inside;                       // by region
  std::vector<int> odd;                           // by region: whether the sum of its levels is
  int flip[3];    // by direction: the sum of the surfaces' degrees is odd

  static int flag(imageint image, int k)
  {
    return static_cast<int>(image >> (k * IMGBITS) & IMGMASK) - IMGMAX;
  }
  void locate();
  Eigen::Vector3d fraction(const double *x, imageint image) const;
};

}    // namespace LAMMPS_NS

#endif
