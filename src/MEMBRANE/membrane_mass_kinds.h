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

#ifndef LMP_MEMBRANE_MASS_KINDS_H
#define LMP_MEMBRANE_MASS_KINDS_H

#include "membrane_mass.h"

#include <memory>
#include <string>

namespace Membrane_NS {

// The kinds of mass matrix there are: a new one has its line in the table of membrane_mass_kinds.cpp.

/// How kinds are called in input scripts.
const char *mass_kind_name(MassKind kind);
/// The kind of that name; false if there is none.
bool find_mass_kind(const std::string &name, MassKind &kind);
/// How many edges the halo of the part has to reach beyond the owned vertices.
int mass_halo_rings(MassKind kind);
/// The matrix of these settings. MeshError if it cannot be made.
std::unique_ptr<MassOperator> make_mass(const VertexMasses &, const MassOperator::Settings &);

}    // namespace Membrane_NS

#endif
