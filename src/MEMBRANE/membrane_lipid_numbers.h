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

#ifndef LMP_MEMBRANE_LIPID_NUMBERS_H
#define LMP_MEMBRANE_LIPID_NUMBERS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace Membrane_NS {

/** Single lipids: each has a face, a leaflet (0 outer, 1 inner) and a kind. How many lipids a face and leaflet
    has never changes, only which. At most 256 kinds. */
class FaceLipids {
 public:
  FaceLipids() = default;
  /// Room for totals[leaflet][face] lipids, all of kind 0.
  FaceLipids(int nkinds, const std::array<std::vector<int>, 2> &totals);

  int num_kinds() const { return nkinds_; }
  int num_faces() const { return static_cast<int>(start_[0].size()) - 1; }
  /// All lipids of a leaflet, and those of a face.
  int size(int leaflet) const { return start_[leaflet].back(); }
  int size(int leaflet, int face) const { return start_[leaflet][face + 1] - start_[leaflet][face]; }
  /// The lipids of a face are those from this one on, size(leaflet, face) of them; their order means nothing.
  int first(int leaflet, int face) const { return start_[leaflet][face]; }
  uint8_t kind(int leaflet, int lipid) const { return kinds_[leaflet][lipid]; }
  uint8_t &kind(int leaflet, int lipid) { return kinds_[leaflet][lipid]; }

  /// Numbers by kind: of a face, added to `n`, and of a leaflet.
  void count(int leaflet, int face, int *n) const;
  std::vector<int> count(int leaflet) const;

  double memory_usage() const;

 private:
  int nkinds_ = 0;
  std::array<std::vector<int>, 2> start_{{{0}, {0}}};
  std::array<std::vector<uint8_t>, 2> kinds_;
};

/** Whole numbers in proportion to the weights, with this sum: each is rounded down, and those with the largest
    remainders get one more, earlier ones first. Weights are not negative and not all 0 unless the sum is 0. */
std::vector<int> largest_remainders(const std::vector<double> &weights, int sum);

/** Fills one leaflet of a membrane. Each face asks for lipids by its area and its composition:
    wanted[face][kind], [faces][kinds], not whole. The numbers of all kinds, over the membrane, are the nearest
    whole ones with the same sum, by largest remainders. Lipids are dealt out face after face: as many as keep their
    sum within a half of what the faces so far have asked for, so that any run of faces is within one of its share
    (largest remainders of faces that all ask for 0.7 would leave the last three tenths of them empty); and always of
    the kind that is farthest behind among those that the face asks for. Returns numbers, [faces][kinds]. */
std::vector<int> fill_faces(const std::vector<double> &wanted, int nkinds);

}    // namespace Membrane_NS

#endif
