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

#ifndef LMP_MEMBRANE_LANES_H
#define LMP_MEMBRANE_LANES_H

#include "membrane_face_groups.h"

#include <cmath>
#include <cstring>
#include <vector>

namespace Membrane_NS {

/// A vector of LANES doubles, one for each face of a block, with elementwise arithmetic.
typedef double Lane __attribute__((vector_size(LANES * sizeof(double))));

/// Three of them: a vector in space for each face.
struct Lane3 {
  Lane x, y, z;

  Lane3() = default;
  Lane3(const Lane3 &) = default;
  /// A lane at a time: compilers copy memory in smaller pieces, which the next load would wait for.
  Lane3 &operator=(const Lane3 &other)
  {
    x = other.x;
    y = other.y;
    z = other.z;
    return *this;
  }
};

inline Lane3 operator+(const Lane3 &a, const Lane3 &b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Lane3 operator-(const Lane3 &a, const Lane3 &b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Lane3 operator*(const Lane &s, const Lane3 &a) { return {s * a.x, s * a.y, s * a.z}; }
inline Lane3 operator*(double s, const Lane3 &a) { return {s * a.x, s * a.y, s * a.z}; }
inline void operator+=(Lane3 &a, const Lane3 &b)
{
  a.x += b.x;
  a.y += b.y;
  a.z += b.z;
}
inline Lane dot(const Lane3 &a, const Lane3 &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Lane3 cross(const Lane3 &a, const Lane3 &b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline Lane sqrt(const Lane &a)
{
  Lane root;
  for (int l = 0; l < LANES; ++l) root[l] = std::sqrt(a[l]);
  return root;
}

inline Lane load(const std::vector<double> &array, int slot)
{
  Lane lane;
  std::memcpy(&lane, array.data() + slot, sizeof(Lane));
  return lane;
}

inline void store(std::vector<double> &array, int slot, const Lane &lane)
{
  std::memcpy(array.data() + slot, &lane, sizeof(Lane));
}

inline Lane3 load3(const std::vector<double> &array, int slot)
{
  Lane3 lane;
  for (int l = 0; l < LANES; ++l) {
    lane.x[l] = array[3 * (slot + l)];
    lane.y[l] = array[3 * (slot + l) + 1];
    lane.z[l] = array[3 * (slot + l) + 2];
  }
  return lane;
}

inline void store3(std::vector<double> &array, int slot, const Lane3 &lane)
{
  for (int l = 0; l < LANES; ++l) {
    array[3 * (slot + l)] = lane.x[l];
    array[3 * (slot + l) + 1] = lane.y[l];
    array[3 * (slot + l) + 2] = lane.z[l];
  }
}

/// Fetches points of a block of faces: points is [size][LANES].
inline void gather(const int *points, int size, const double (*x)[3], Lane3 *out)
{
  for (int k = 0; k < size; ++k)
    for (int l = 0; l < LANES; ++l) {
      const double *p = x[points[k * LANES + l]];
      out[k].x[l] = p[0];
      out[k].y[l] = p[1];
      out[k].z[l] = p[2];
    }
}

/// Subtracts gradients at points of the first faces of a block from forces.
inline void subtract(const int *points, int size, int faces, const Lane3 *g, double (*f)[3])
{
  typedef double Pair __attribute__((vector_size(2 * sizeof(double))));
  for (int k = 0; k < size; ++k) {
    const Lane x = g[k].x, y = g[k].y, z = g[k].z;
    const int *point = points + k * LANES;
    auto take = [&](int l) {
      double *force = f[point[l]];
      Pair xy;    // both at once
      std::memcpy(&xy, force, sizeof(xy));
      xy -= Pair{x[l], y[l]};
      std::memcpy(force, &xy, sizeof(xy));
      force[2] -= z[l];
    };
    if (faces == LANES)
      for (int l = 0; l < LANES; ++l) take(l);
    else
      for (int l = 0; l < faces; ++l) take(l);
  }
}

/// Adds the virial xx yy zz xy xz yz of a gradient at a place.
inline void add_virial(const Lane3 &place, const Lane3 &gradient, Lane (&virial)[6])
{
  virial[0] -= place.x * gradient.x;
  virial[1] -= place.y * gradient.y;
  virial[2] -= place.z * gradient.z;
  virial[3] -= place.x * gradient.y;
  virial[4] -= place.x * gradient.z;
  virial[5] -= place.y * gradient.z;
}

/// A linear combination of the control points of the faces.
inline Lane3 combine(const double *weights, const Lane3 *x, int size)
{
  Lane3 sum = weights[0] * x[0];
  for (int k = 1; k < size; ++k) sum += weights[k] * x[k];
  return sum;
}

}    // namespace Membrane_NS

#endif
