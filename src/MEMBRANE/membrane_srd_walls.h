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

#ifndef LMP_MEMBRANE_SRD_WALLS_H
#define LMP_MEMBRANE_SRD_WALLS_H

namespace Membrane_NS {

/** Flat walls at faces of the box, perpendicular to the axes, which solvent meets in continuous
    time. Faces are numbered xlo, xhi, ylo, yhi, zlo, zhi. */
class BoxWalls {
 public:
  static constexpr int FACES = 6;
  bool present[FACES] = {};
  double position[FACES] = {};
  double velocity[FACES][3] = {};    ///< within the plane of the wall
  bool noslip = true;
  double impulse[3] = {};    ///< momentum that the walls of this rank have taken so far

  bool any() const
  {
    for (bool p : present)
      if (p) return true;
    return false;
  }

  /** How long until a particle that keeps its velocity meets a wall: at most `time`. face: the
      wall, or -1 if it meets none by then. One that is beyond a wall and moves away meets it at
      once. */
  double first_hit(const double *x, const double *v, double time, int &face) const
  {
    face = -1;
    for (int f = 0; f < FACES; ++f) {
      const double speed = f % 2 ? v[f / 2] : -v[f / 2];
      if (!present[f] || !(speed > 0.0)) continue;
      const double way = f % 2 ? position[f] - x[f / 2] : x[f / 2] - position[f];
      const double when = way > 0.0 ? way / speed : 0.0;
      if (when < time) {
        time = when;
        face = f;
      }
    }
    return time;
  }

  /// A particle at a wall: reversed relative to the wall if noslip, mirrored otherwise.
  void bounce(double *v, double mass, int face)
  {
    const int normal = face / 2;
    for (int k = 0; k < 3; ++k) {
      if (k != normal && !noslip) continue;
      const double before = v[k];
      v[k] = 2.0 * velocity[face][k] - v[k];
      impulse[k] += mass * (before - v[k]);
    }
  }

  /// x and v after `time`; whether the particle has met a wall.
  bool stream(double *x, double *v, double mass, double time)
  {
    for (bool met = false;; met = true) {
      int face;
      const double step = first_hit(x, v, time, face);
      for (int k = 0; k < 3; ++k) x[k] += step * v[k];
      if (face < 0) return met;
      x[face / 2] = position[face];
      bounce(v, mass, face);
      time -= step;
    }
  }
};

}    // namespace Membrane_NS

#endif
