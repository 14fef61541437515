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

#ifndef LMP_MEMBRANE_MOLECULE_RINGS_H
#define LMP_MEMBRANE_MOLECULE_RINGS_H

#include "membrane_molecule_crowd.h"

namespace Membrane_NS {

/// A bond of one lipid that goes through a ring of another.
struct PiercedRing {
  int ring_of, bond_of;    ///< lipids
};

/// All there are; none without bonds or rings. A ring is the triangles between its bonds and its centre.
std::vector<PiercedRing> find_pierced_rings(const LipidCrowd &crowd);

/// Turns, exchanges or slides one of the two until no bond goes through a ring; returns those that are left.
std::vector<PiercedRing> free_rings(LipidCrowd &crowd);

}    // namespace Membrane_NS

#endif
