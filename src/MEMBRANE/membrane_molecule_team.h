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

#ifndef LMP_MEMBRANE_MOLECULE_TEAM_H
#define LMP_MEMBRANE_MOLECULE_TEAM_H

#include <string>
#include <utility>
#include <vector>

namespace Membrane_NS {

/// Those who build a structure together: each has all of it, works out a part, and tells the others. This one
/// is alone.
class Team {
 public:
  virtual ~Team() noexcept(false) = default;
  virtual int rank() const { return 0; }
  virtual int size() const { return 1; }
  /// Collective: what all have, in the order of ranks.
  virtual std::vector<char> concatenate(const std::vector<char> &mine) { return mine; }
  /// Progress, for the user to see.
  virtual void say(const std::string &) {}

  /// The part of n things that is this one's: first to last - 1.
  std::pair<int, int> part(int n) const
  {
    auto start = [&](long long r) { return static_cast<int>(r * n / size()); };
    return {start(rank()), start(rank() + 1)};
  }
};

/// The same of plain data.
template <class T> std::vector<T> concatenate(Team &team, const std::vector<T> &mine)
{
  if (team.size() == 1) return mine;
  const char *bytes = reinterpret_cast<const char *>(mine.data());
  const std::vector<char> all = team.concatenate({bytes, bytes + mine.size() * sizeof(T)});
  const T *first = reinterpret_cast<const T *>(all.data());
  return {first, first + all.size() / sizeof(T)};
}

}    // namespace Membrane_NS

#endif
