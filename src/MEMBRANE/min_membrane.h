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

#ifdef MINIMIZE_CLASS
// clang-format off
MinimizeStyle(membrane,MinMembrane);
// clang-format on
#else

#ifndef LMP_MIN_MEMBRANE_H
#define LMP_MIN_MEMBRANE_H

#include "membrane_metric.h"
#include "mesh_local.h"
#include "min_linesearch.h"

#include <array>
#include <memory>
#include <vector>

namespace LAMMPS_NS {

/// Limited-memory BFGS in the metric of the bending energy.
class MinMembrane : public MinLineSearch {
 public:
  MinMembrane(class LAMMPS *);

  void init() override;
  void setup_style() override;
  void reset_vectors() override;
  int iterate(int) override;

 private:
  static constexpr int MEMORY = 40;

  LocalMesh mesh;
  std::unique_ptr<Membrane_NS::BendingMetric> metric;
  Membrane_NS::TriangleMesh shape;               // at the start of the iteration
  Eigen::VectorXd moduli;                        // by vertex
  std::vector<std::array<int, 2>> edges;         // each once
  Eigen::VectorXd lengths, lengths_of_metric;    // of the edges: of shape, of the metric's
  std::vector<double> farthest;                  // a control point may move, by component
  double angle_at_start;                         // smallest of the mesh

  // pairs of steps s and gradient changes y, in a ring buffer; kept by fix minimize

  double *s[MEMORY], *y[MEMORY];
  double rho[MEMORY];
  int pairs, newest;

  void find_moduli();
  void build_metric();
  bool metric_outdated() const;
  double smallest_angle(int &) const;
  double dot(const double *, const double *) const;
  Membrane_NS::BendingMetric::Vectors gather(const double *);
  void read_shape();
  void measure_edges();
  void precondition(double *);
  double longest_step();
  void direction();
  int search(double &);
  int descend(int);
  void report_mesh();
};

}    // namespace LAMMPS_NS

#endif
#endif
