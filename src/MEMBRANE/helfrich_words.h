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

#ifndef LMP_HELFRICH_WORDS_H
#define LMP_HELFRICH_WORDS_H

#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// A keyword of pair_coeff of pair style helfrich and what follows it. Errors name what is wrong.
class HelfrichWords : protected Pointers {
 public:
  /// `keywords` are all that may follow.
  HelfrichWords(class LAMMPS *lmp, int narg, char **arg, const std::vector<std::string> &keywords) :
      Pointers(lmp), narg(narg), arg(arg), keywords(keywords)
  {
  }

  std::string keyword() const { return arg[0]; }
  /// The i-th word after the keyword, from 1.
  std::string word(int i) const;
  /// Whether there is an i-th word and it is this one.
  bool is(int i, const std::string &word) const { return i < narg && word == arg[i]; }
  /// Whether what was said of the keyword ends before the i-th word.
  bool at_end(int i) const;
  double number(int i) const;
  /// A number that is not negative.
  double modulus(int i) const;
  /// A number, or false where the word is "init".
  bool number_or_init(int i, double &value) const;

 private:
  int narg;
  char **arg;
  const std::vector<std::string> &keywords;
};

}    // namespace LAMMPS_NS

#endif
