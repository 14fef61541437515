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

#include "membrane_stencil.h"

using namespace Membrane_NS;

/* ---------------------------------------------------------------------- */

void Membrane_NS::stencil_points(const Topology &topology, const TriangleMesh &control, int face,
                                 StencilPoints &points)
{
  std::vector<int> stencil;
  topology.stencil(face, stencil);
  points.resize(stencil.size(), 3);
  points.row(0) = control.points[stencil[0]].transpose();
  topology.along_stencil(stencil, [&](int column, int anchor) {
    points.row(column) =
        points.row(anchor) + control.edge(stencil[anchor], stencil[column]).transpose();
  });
}
