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

#ifndef LMP_MEMBRANE_LIPID_LIBRARY_H
#define LMP_MEMBRANE_LIPID_LIBRARY_H

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace Membrane_NS {

/// Lipids that are not what they should be; what() names them and the cure.
class LipidError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/** A kind of lipid. c0 is the spontaneous curvature of a monolayer of it at the neutral surface, as 2H,
    positive where head groups are outside: a sphere of radius R of its own liking has c0 = 2/R, and a
    cylinder as in an inverted hexagonal phase c0 = -1/R. Any consistent units. */
struct LipidKind {
  std::string name;
  double area = 0.0;    ///< of a lipid in the plane
  double c0 = 0.0;

  bool same(const LipidKind &o) const { return name == o.name && area == o.area && c0 == o.c0; }
};

/// Kinds of lipids by name and number, from 0.
class LipidLibrary {
 public:
  /** Adds a kind and returns its number; the same once more is no other. Throws LipidError if its name is
      there with other numbers, or if these are not finite or the area is not positive. */
  int add(const LipidKind &);
  /** Adds what the lines `name area c0` of a text say; # begins a comment. Areas and curvatures are in
      units of `length`. Errors name `path` and the line. */
  void read(const std::string &text, const std::string &path, double length);

  int size() const { return static_cast<int>(kinds.size()); }
  const LipidKind &operator[](int kind) const { return kinds[kind]; }
  /// The number of a kind, or -1.
  int find(const std::string &name) const;
  /// All of them, for messages.
  std::string names() const;

 private:
  std::vector<LipidKind> kinds;
};

/// What a leaflet is made of: fractions of kinds of a library by number of lipids.
struct LeafletComposition {
  std::vector<std::pair<int, double>> parts;    ///< kind and fraction

  /// So many parts more; throws LipidError if they are negative or not finite.
  void add(const LipidKind &named, int kind, double more);
  /// Makes the sum of the parts 1; throws LipidError if it is 0.
  void normalize();
  /// Mean area of a lipid.
  double area(const LipidLibrary &) const;
  /// Spontaneous curvature of the monolayer: the mean of the kinds', weighted by area.
  double curvature(const LipidLibrary &) const;
};

}    // namespace Membrane_NS

#endif
