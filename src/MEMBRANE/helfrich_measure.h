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

#ifndef LMP_HELFRICH_MEASURE_H
#define LMP_HELFRICH_MEASURE_H


namespace LAMMPS_NS {

/** The temperature at which a fix samples the shapes of membranes. Pair style helfrich takes it from
    Fix::extract("measure") and adds the energy of the measure, see membrane_measure.h. */
struct HelfrichMeasure {
  bool on = false;     ///< may change between runs
  double kT = 0.0;     ///< in energy; may change from step to step
  int groupbit = 0;    ///< membranes with control points in this group
  bool tally = false;
  double logs = 0.0;   ///< if so, pair helfrich writes: the energy over kT, on this rank
};

}    // namespace LAMMPS_NS

#endif
