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

#ifndef MEMBRANE_TEST_HOW_MANY_H
#define MEMBRANE_TEST_HOW_MANY_H

#include <algorithm>
#include <cstdlib>

namespace Membrane_TEST {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool SANITIZED = true;
#else
constexpr bool SANITIZED = false;
#endif

/// How many samples a test takes: `number`, an eighth of them under the sanitizers, which are slow
/// and look at the ways through the code, `in_a_long_run` with MEMBRANE_LONG.
inline int how_many(int number, int in_a_long_run = 0)
{
  if (in_a_long_run && std::getenv("MEMBRANE_LONG")) return in_a_long_run;
  return SANITIZED ? std::max(1, number / 8) : number;
}

/// The step of a loop over valences and other kinds that are slow: all of them, under the sanitizers
/// one in five.
constexpr int STRIDE = SANITIZED ? 5 : 1;

}    // namespace Membrane_TEST

#endif
