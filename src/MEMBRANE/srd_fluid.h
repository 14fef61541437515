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

#ifndef LMP_SRD_FLUID_H
#define LMP_SRD_FLUID_H

#include "pointers.h"
#include "srd_cells.h"

namespace LAMMPS_NS {

/// What kind of fluid the solvent of a fix srd/mesh is: its temperature, free path and viscosity
/// follow from the words of the command, its masses, its density and the box.
class SRDFluid : protected Pointers {
 public:
  /// The arguments must outlive this.
  SRDFluid(class LAMMPS *, const struct SRDMeshArguments &);

  /// Collective: temperature, mean mass and mean free path of solvent that collides every so many
  /// steps.
  void measure(const class SRDSolvent &);
  /// After that: what rules of collision there are; stops if the free path is too short for them.
  SRDCells::Settings cell_settings() const;
  /// And of cells that fit the box; stops if they are far from cubes of the wanted size, or warns
  /// if asked to.
  void fit(const SRDGrid &, bool warn);
  /// What each side of the membranes (0 even, 1 odd, see SurfaceRegions) has of the solvent and of the box.
  struct Sides {
    bigint atoms[2];
    double volume[2];
  };
  /// After fit(): solvent fills the sides that have some, each with a density of its own.
  void fit_sides(const SRDGrid &, const Sides &);
  void report(const SRDGrid &) const;

  double temperature() const { return temp; }
  /// In units of mass times velocity squared.
  double kT() const;
  double mass() const { return mean_mass; }
  double free_path() const { return path; }
  /// Mean number in a cell of the space that has solvent.
  double filling() const { return in_cell; }
  double viscosity() const { return eta; }
  /// The same of one side; 0 without solvent there, or without membranes.
  double viscosity(int side) const { return side_eta[side]; }
  bigint count() const { return atoms; }

 private:
  const SRDMeshArguments &given;
  double temp, mean_mass, path, in_cell, eta;
  double side_in_cell[2], side_eta[2];
  bigint atoms;

  double step() const;
  double viscosity_of(double in_cell, const SRDGrid &) const;
};

}    // namespace LAMMPS_NS

#endif
