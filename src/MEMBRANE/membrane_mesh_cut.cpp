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

#include "membrane_mesh_soup.h"

#include <algorithm>

using namespace Membrane_NS;
using Eigen::Vector3d;

namespace {

/// What is left of a polygon, seen along its normal.
class Rest {
 public:
  explicit Rest(const std::vector<Vector3d> &x) : x_(x), normal_(Vector3d::Zero())
  {
    const int n = static_cast<int>(x.size());
    for (int i = 0; i < n; ++i) {
      corners_.push_back(i);
      normal_ += (x[i] - x[0]).cross(x[(i + 1) % n] - x[0]);
    }
  }

  int size() const { return static_cast<int>(corners_.size()); }
  Face ear(int i) const { return {corner(i - 1), corner(i), corner(i + 1)}; }
  void cut_off(int i) { corners_.erase(corners_.begin() + i); }
  double diagonal(int i) const { return (x_[corner(i + 1)] - x_[corner(i - 1)]).squaredNorm(); }

  bool is_clear(int i) const
  {
    const Face tip = ear(i);
    if (!(area(tip) > 0.0)) return false;
    for (int j : corners_)
      if (corner_of(tip, j) < 0 && area({tip[0], tip[1], j}) >= 0.0 &&
          area({tip[1], tip[2], j}) >= 0.0 && area({tip[2], tip[0], j}) >= 0.0)
        return false;
    return true;
  }

 private:
  const std::vector<Vector3d> &x_;
  Vector3d normal_;
  std::vector<int> corners_;

  int corner(int i) const { return corners_[(i + size()) % size()]; }
  double area(const Face &t) const
  {
    return normal_.dot((x_[t[1]] - x_[t[0]]).cross(x_[t[2]] - x_[t[0]]));
  }
};

}    // namespace

/* ----------------------------------------------------------------------
   a polygon that crosses itself may have no clear ear: then the shortest diagonal is cut all the same
------------------------------------------------------------------------- */

std::vector<Face> Membrane_NS::cut_polygon(const std::vector<Vector3d> &x)
{
  std::vector<Face> triangles;
  Rest rest(x);
  while (rest.size() > 3) {
    std::vector<std::pair<double, int>> ears;
    for (int i = 0; i < rest.size(); ++i) ears.emplace_back(rest.diagonal(i), i);
    std::sort(ears.begin(), ears.end());
    auto best = std::find_if(ears.begin(), ears.end(), [&rest](const auto &ear) {
      return rest.is_clear(ear.second);
    });
    if (best == ears.end()) best = ears.begin();
    triangles.push_back(rest.ear(best->second));
    rest.cut_off(best->second);
  }
  triangles.push_back(rest.ear(1));
  return triangles;
}
