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

#ifndef LMP_MEMBRANE_BLOCKS_H
#define LMP_MEMBRANE_BLOCKS_H

#include <cstdint>
#include <vector>

namespace Membrane_NS {

/** Means of several series of correlated samples, with their standard errors, while samples come in: the
    scatter of means of blocks of 1, 2, 4, ... samples [H. Flyvbjerg and H. G. Petersen, J. Chem. Phys. 91,
    461 (1989)]. Memory grows with the logarithm of the number of samples. */
class BlockAverages {
 public:
  explicit BlockAverages(int nseries = 0) : nseries_(nseries) {}

  /// One sample of each series.
  void add(const std::vector<double> &sample);
  int64_t count() const { return levels_.empty() ? 0 : levels_[0].count; }
  double mean(int series) const;

  /** Of the mean, from the shortest blocks that make up for correlations: with B samples each such that
      B^3 > 2 n (e/e_1)^4, e the error that they give and e_1 that of blocks of one sample, the error of e by
      what is left of correlations is as small as that by the number of blocks [U. Wolff, Comput. Phys.
      Commun. 156, 143 (2004); R. M. Lee et al., Phys. Rev. E 83, 066706 (2011)]. A series too short for
      this has the largest error that eight blocks or more give. 0 of fewer than two samples. */
  double error(int series) const;

  /// The integrated autocorrelation time, in samples, that goes with the error; 1/2 without correlations.
  double correlation(int series) const;

  /// What is to be kept to go on later: file(x) for each number.
  template <class Archive> void archive(Archive &file)
  {
    file(nseries_);
    file(first_);
    file(levels_);
  }

 private:
  struct Level {
    int64_t count = 0;
    bool waiting = false;    // for the second half of a block of the next level
    std::vector<double> sum, square, half;
    template <class Archive> void archive(Archive &file)
    {
      file(count);
      file(waiting);
      file(sum);
      file(square);
      file(half);
    }
  };
  int nseries_;
  std::vector<double> first_;    // what is subtracted from all, against cancellation
  std::vector<Level> levels_;

  double scatter(int level, int series) const;
};

}    // namespace Membrane_NS

#endif
