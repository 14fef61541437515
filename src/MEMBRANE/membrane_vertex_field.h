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

#ifndef LMP_MEMBRANE_VERTEX_FIELD_H
#define LMP_MEMBRANE_VERTEX_FIELD_H

#include <vector>

namespace Membrane_NS {

/// x, y, z of a vertex, and a fourth number so that vertices are aligned to vector units.
struct alignas(32) Vector4 {
  double c[4];
};
using VertexField = std::vector<Vector4>;

/// The four numbers of a vertex as one value of the compiler's vector extension.
typedef double Quad __attribute__((vector_size(sizeof(Vector4)), may_alias));

inline const Quad &quad(const Vector4 &v) { return reinterpret_cast<const Quad &>(v); }
inline Quad &quad(Vector4 &v) { return reinterpret_cast<Quad &>(v); }

}    // namespace Membrane_NS

#endif
