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

#ifndef LMP_MEMBRANE_QUADRATURE_H
#define LMP_MEMBRANE_QUADRATURE_H

#include "membrane_limit_basis.h"
#include "membrane_threefold.h"

#include <map>
#include <string>
#include <vector>

namespace Membrane_NS {

/** How finely integrals over the limit surface are taken.

    ONE, THREE, SIX, TWELVE: that many Gauss points on a regular face, exact for polynomials of
    degree 1, 2, 4, 6; see PatchRules for others and for regular ones near a vertex of large valence. CAREFUL: as many as 1e-7 of the energy of a well-shaped mesh needs. */
enum class Quadrature { ONE, THREE, SIX, TWELVE, CAREFUL };

/// From "1", "3", "6", "12", "careful"; false if it is none of these.
bool parse_quadrature(const std::string &word, Quadrature &quadrature);
/// The word for a rule.
std::string quadrature_name(Quadrature quadrature);

/// Points (u, v) and weights on the triangle 0 <= u, v, u+v <= 1; the weights sum to 1/2.
struct TriangleRule {
  std::vector<double> u, v, weight;
  int size() const { return static_cast<int>(weight.size()); }
};
TriangleRule triangle_rule(Quadrature quadrature);

struct PatchRule;

/** A face that is cut in four: the rules of its quarters, and their control points, each of which is the mean of a few
    of the face. */
struct FaceCut {
  struct Quarter {
    const PatchRule *rule;
    std::vector<int> points;    ///< [rule->size]
  };
  std::vector<Quarter> quarters;    ///< four, or none if the face is not cut
  // point i is the sum over j from start[i] to start[i + 1] of weight[j] times control point from[j] of the face
  std::vector<int> start, from;
  std::vector<double> weight;

  bool empty() const { return quarters.empty(); }
  /// Of control points of the quarters.
  int size() const { return empty() ? 0 : static_cast<int>(start.size()) - 1; }
};

/** The quadrature of a face with given valences, as data: for each point its weights and the rows
    of LimitBasis::Row. Derivatives are with respect to parameters chosen for each point such that
    they stay of the order of an edge; an integral is sum_points weight f(r, r_u, ...) for any f
    that is a density in the parameters, like |r_u x r_v|. What depends on curvature takes `weight`, and
    what does not, like area and volume, `area_weight`: they differ in fitted rules only. */
struct PatchRule {
  int size = 0;      ///< control points of the face
  int npoints = 0;
  std::vector<double> weight, area_weight;    ///< [npoints]
  std::vector<double> rows;                   ///< [npoints][LimitBasis::ROWS][size]
  std::vector<ThreefoldPoint> threefold;      ///< the same points by threes, if that is how they are
  FaceCut cut;                                ///< the same points by quarters, likewise
  const double *row(int point, int which) const
  {
    return rows.data() + (static_cast<size_t>(point) * LimitBasis::ROWS + which) * size;
  }
};

/** Builds patch rules on demand and keeps them; references stay valid.

    Around extraordinary corners of the valences that meshes have in number THREE and SIX take few points that were
    fitted to the corner, see membrane_quadrature_corners.h: on the whole face if it has one such corner, of valence
    8 at most, else the face is cut in four, and they go on the quarters at its corners.

    Other rules and corners are graded and self-similar: the face is cut in four, the
    part at the corner again, and so on, each regular part getting the triangle rule, or from the
    third cut on, which leaves parts an eighth as wide as the face, the next coarser one (SIX and TWELVE).
    The last, the tip, is integrated too: a rule that leaves it out lets a minimiser hide energy there. The
    number of levels follows from how fast the energy of a level decays at that valence, so that
    the tip holds 1e-4 of the patch's energy (CAREFUL: 1e-11).

    Around vertices of valence 11 and more faces are narrow, and THREE and SIX take the next finer triangle rule on regular
    faces, see Topology::is_squeezed(), on regular quarters of the vertex's own, and in graded rules, from the
    third cut on the next coarser one to that. */
class PatchRules {
 public:
  explicit PatchRules(Quadrature quadrature);
  /// With another rule than the next finer one where faces are narrow.
  PatchRules(Quadrature quadrature, Quadrature narrow);
  PatchRules(const PatchRules &) = delete;    // rules of faces point to those of their quarters
  /// Of a face that is not squeezed, see Topology::is_squeezed().
  const PatchRule &get(const Valences &valences);
  /// Of one that is, which is regular.
  const PatchRule &squeezed();
  Quadrature quadrature() const { return quadrature_; }
  double memory_usage() const;

 private:
  Quadrature quadrature_, narrow_;
  TriangleRule triangle_;
  std::map<Valences, PatchRule> rules_;
  std::map<int, PatchRule> tips_;    // by valence: the patch (n, 6, 6)
  PatchRule squeezed_;

  PatchRule build(const Valences &valences);
  const PatchRule &tip(int n);
  PatchRule graded(int n) const;
  const PatchRule &quarter(const Valences &valences, int child);
  FaceCut cut(const LimitBasis &basis, const Valences &valences);
  PatchRule regular_children(const LimitBasis &basis, Quadrature quadrature) const;
};

}    // namespace Membrane_NS

#endif
