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

#ifndef LMP_HELFRICH_COEFFICIENTS_H
#define LMP_HELFRICH_COEFFICIENTS_H

#include "pointers.h"

namespace LAMMPS_NS {

/// What a pair_coeff line of pair style helfrich says of a type of control points.
struct HelfrichCoefficients {
  bool set = false;
  bool fresh = false;    ///< since the last run: "init" is to be taken anew
  double kc = 0.0, c0 = 0.0, kg = 0.0;
  double tension = 0.0;                     ///< S: energy S A
  double area_modulus = 0.0, area = 0.0;    ///< KA/2 (A-A0)^2/A0 per membrane
  double local_area_modulus = 0.0;          ///< KA/2 sum (a-a0)^2/a0 over faces
  double volume_modulus = 0.0, volume = 0.0;
  double pressure = 0.0;      ///< DP: energy -DP V
  double regularize = 0.0;    ///< KR: energy KR (D/A - 1) of a face's shape
  bool area_init = false, volume_init = false, regularize_given = false;

  /// The words kc c0 [keyword value ...]; stops with an error that names what is wrong.
  static HelfrichCoefficients parse(class LAMMPS *, int narg, char **arg);

  /// Whether the terms of a whole membrane are the same.
  bool same_global_terms(const HelfrichCoefficients &) const;
  bool uses_volume() const { return volume_modulus != 0.0 || pressure != 0.0; }
  bool uses_totals() const
  {
    return area_modulus != 0.0 || local_area_modulus != 0.0 || uses_volume();
  }
};

}    // namespace LAMMPS_NS

#endif
