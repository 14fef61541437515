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

#include "membrane_metric.h"

#include "membrane_cotangent.h"

using namespace Membrane_NS;

BendingMetric::BendingMetric(const TriangleMesh &mesh, const Topology &topology,
                             const Eigen::VectorXd &kc)
{
  const FlatAreas areas(mesh, topology);
  Eigen::VectorXd shift = 4.0 * M_PI * areas.vertices;
  for (int v = 0; v < topology.num_vertices(); ++v)
    shift[v] /= areas.components[topology.component(v)];
  Eigen::SparseMatrix<double> matrix =
      cotangent_laplacian(mesh, topology, std::vector<double>(topology.num_faces(), 1.0));
  matrix.diagonal() += shift;
  laplacian_.compute(matrix);
  compliance_ = areas.vertices.cwiseQuotient(kc);
}

BendingMetric::Vectors BendingMetric::solve(const Vectors &f) const
{
  Vectors first = laplacian_.solve(f);
  first.array().colwise() *= compliance_.array();
  return laplacian_.solve(first);
}
