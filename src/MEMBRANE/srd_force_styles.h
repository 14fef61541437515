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

#ifndef LMP_SRD_FORCE_STYLES_H
#define LMP_SRD_FORCE_STYLES_H

namespace LAMMPS_NS {

/// Collective: whether a pair, bond, angle, dihedral, improper or kspace style acts on atoms of the group.
bool feel_force_styles(class LAMMPS *, int groupbit);

}    // namespace LAMMPS_NS

#endif
