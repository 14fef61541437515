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

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(membrane/lipids,ComputeMembraneLipids);
// clang-format on
#else

#ifndef LMP_COMPUTE_MEMBRANE_LIPIDS_H
#define LMP_COMPUTE_MEMBRANE_LIPIDS_H

#include "compute.h"
#include "membrane_quadrature.h"
#include "mesh_local.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Numbers of the lipids that fix hd/lipids moves, by leaflet and kind, and where they are.
class ComputeMembraneLipids : public Compute {
 public:
  ComputeMembraneLipids(class LAMMPS *, int, char **);
  ~ComputeMembraneLipids() override;

  void init() override;
  /// Numbers of all kinds in the outer leaflet, then in the inner one.
  void compute_vector() override;
  /// The same in rows: number, fraction of the leaflet, mean 2H where they are, correlation with 2H.
  void compute_array() override;
  /// By face, in the order of compute property/local: numbers of the kinds asked for, curvatures.
  void compute_local() override;
  int lock_length() override { return size_vector; }
  double memory_usage() override;

 private:
  struct Column {
    int leaflet;    // or CURVATURE or BEND of the source
    std::string name;
  };
  LocalMesh mesh;
  Membrane_NS::PatchRules rules;
  std::vector<Column> columns;
  int most_faces;

  const struct LipidPlaces &places();
  std::vector<char> chosen() const;
  void resize(int nkinds);
  std::vector<double> bends();
  int list_faces(bool write, const std::vector<double> &bend);
};

}    // namespace LAMMPS_NS

#endif
#endif
