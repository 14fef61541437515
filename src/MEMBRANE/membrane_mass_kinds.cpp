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

#include "membrane_mass_kinds.h"

#include "membrane_mass_consistent.h"
#include "membrane_mass_lumped.h"
#include "membrane_mass_sampling.h"
#include "membrane_mass_vertex.h"

using namespace Membrane_NS;

namespace {

template <class Mass>
std::unique_ptr<MassOperator> make(const VertexMasses &vertices,
                                   const MassOperator::Settings &settings)
{
  return std::make_unique<Mass>(vertices, settings);
}

// by MassKind

struct Kind {
  const char *name;
  int halo_rings;
  std::unique_ptr<MassOperator> (*make)(const VertexMasses &, const MassOperator::Settings &);
};
constexpr Kind KINDS[] = {{"vertex", 1, make<VertexMass>},
                          {"consistent", 3, make<ConsistentMass>},
                          {"lumped", 0, make<LumpedMass>},
                          {"sampling", 0, make<SamplingMass>}};

const Kind &description(MassKind kind)
{
  return KINDS[static_cast<int>(kind)];
}

}    // namespace

const char *Membrane_NS::mass_kind_name(MassKind kind)
{
  return description(kind).name;
}

bool Membrane_NS::find_mass_kind(const std::string &name, MassKind &kind)
{
  for (const Kind &known : KINDS)
    if (name == known.name) {
      kind = static_cast<MassKind>(&known - KINDS);
      return true;
    }
  return false;
}

std::unique_ptr<MassOperator> Membrane_NS::make_mass(const VertexMasses &vertices,
                                                     const MassOperator::Settings &settings)
{
  return description(settings.kind).make(vertices, settings);
}

int Membrane_NS::mass_halo_rings(MassKind kind)
{
  return description(kind).halo_rings;
}
