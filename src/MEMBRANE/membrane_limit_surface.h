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

#ifndef LMP_MEMBRANE_LIMIT_SURFACE_H
#define LMP_MEMBRANE_LIMIT_SURFACE_H

#include "membrane_limit_patch.h"
#include "membrane_surface_jet.h"
#include "membrane_surface_point.h"
#include "membrane_triangle_mesh.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace Membrane_NS {

/** The polynomial that a face is near a point, kept for the next evaluation there. Belongs to one
    LimitSurface until that moves. */
struct SurfacePiece {
  int face = -1;
  RegularPart part;
  Lane4 origin;
  Quartics<4> polynomial;

  bool contains(const SurfacePoint &p) const { return p.face == face && part.contains(p.u, p.v); }
};

/** The limit surface over the faces of a topology, to be evaluated at SurfacePoints. Where the control points
    are, is known to the classes derived from this: LimitSurfaceOfMesh, and on the ranks of a simulation
    LocalSurface. Evaluation does not allocate and changes nothing.

    In a periodic box every face is somewhere, and its control points are the images that belong to it;
    neighbouring faces may be images apart: use nearest_image() of differences. */
class LimitSurface {
 public:
  virtual ~LimitSurface() = default;

  const Topology &topology() const { return topology_; }

  // === Evaluation

  /** Position and derivatives up to ORDER (0, 1, 2 or 3). At an extraordinary corner see LimitBasis.
      Third derivatives jump across edges and inside faces that are not regular. Towards an
      extraordinary corner at distance s, derivatives of order m go as s^(g - m), g = -log2 of
      subdominant_eigenvalue(): 2 at valence 3, 1 at 6, 0.7 at 20. */
  template <int ORDER = 2> SurfaceJet evaluate(const SurfacePoint &p) const;
  /// The same, with a polynomial that is worked out anew only where the point has left it.
  template <int ORDER = 2>
  void evaluate(const SurfacePoint &p, SurfacePiece &piece, SurfaceJet &jet) const;

  /** Weights of the control points, rows up to ORDER; the columns are stencil(p.face). The force f on a
      point bound to p is weights(VALUE, k) f on control point k. */
  template <int ORDER = 0> void weights(const SurfacePoint &p, SurfaceWeights &out) const;
  /// The control points of a face as Topology::stencil() has them.
  IntSpan stencil(int face) const
  {
    return {stencil_.data() + start_[face], stencil_.data() + start_[face + 1]};
  }
  int stencil_size(int face) const { return patch_[face]->size(); }
  /// Has the processor read what evaluation needs to know of a face, while it does something else.
  void prefetch(int face) const { __builtin_prefetch(&patch_[face]); }
  /// Where these are, in the images that belong to the face: x has room for MOST_STENCIL.
  void control_points(int face, Lane4 *x) const { gather(face, x); }

  // === Extraordinary vertices

  /// The corner of its face that an extraordinary point is at, or -1.
  int corner_at(const SurfacePoint &p) const { return patch_[p.face]->corner_at(p.u, p.v); }
  /** Position and exact tangents at corner k of a face: columns 1 and 2 are those in which neighbour i of
      the vertex is in the direction cos(2 pi i/n), sin(2 pi i/n), as Topology::ring() has them. */
  Eigen::Matrix3d vertex_frame(int face, int k) const;

  // === The box and the size of things

  bool is_periodic() const { return periodic_[0] || periodic_[1] || periodic_[2]; }
  const std::array<bool, 3> &periodic() const { return periodic_; }
  const Eigen::Matrix3d &lattice() const { return lattice_; }
  /// The periodic image of a difference whose fractional coordinates lie within +-1/2.
  Eigen::Vector3d nearest_image(const Eigen::Vector3d &difference) const
  {
    return difference.squaredNorm() < surely_nearest2_ ? difference : image_of(difference);
  }
  /// The mean length of the edges between control points.
  double mean_edge() const { return mean_edge_; }

  /// Bytes held.
  virtual double memory_usage() const;

 protected:
  /// The topology must outlive this. MeshError for valences beyond MOST_VALENCE.
  LimitSurface(const Topology &topology, const std::array<bool, 3> &periodic);

  /// The control points of a face, as stencil() has them.
  virtual void gather(int face, Lane4 *x) const = 0;
  void set_box(const Eigen::Matrix3d &lattice);
  void set_mean_edge(double length) { mean_edge_ = length; }

  const Topology &topology_;
  std::array<bool, 3> periodic_;
  Eigen::Matrix3d lattice_, to_fraction_;
  std::vector<int> start_, stencil_;    // the stencils of all faces

 private:
  double mean_edge_ = 0.0;
  double surely_nearest2_ = INFINITY;    // a difference with a smaller square needs no other image
  LimitPatches patches_;
  std::vector<const LimitPatch *> patch_;    // [faces]

  Eigen::Vector3d image_of(const Eigen::Vector3d &difference) const;
  void make_piece(const SurfacePoint &p, SurfacePiece &piece) const;
};

/** The limit surface of a mesh. Built once for a topology, moved as often as the control points move. Several
    threads may evaluate at a time.

    In a periodic box every face is where its first corner is. Points are followed through the
    box, so positions may come to lie outside of it. */
class LimitSurfaceOfMesh : public LimitSurface {
 public:
  /** The topology must outlive this. MeshError for valences beyond MOST_VALENCE.
      Edges must be shorter than half the box in periodic directions. */
  LimitSurfaceOfMesh(const Topology &topology, const TriangleMesh &control);

  /** New places of the control points, any periodic image of them, and a new box, of the same
      periodicity. In box vectors no point may have moved by half a box. */
  void move(const std::vector<Eigen::Vector3d> &points, const Eigen::Matrix3d &lattice);
  /// The same box.
  void move(const std::vector<Eigen::Vector3d> &points) { move(points, lattice_); }

  double memory_usage() const override;

 private:
  std::vector<Lane4> points_;           // followed through the box
  std::vector<std::uint16_t> image_;    // of each point of a stencil, in translation_; if periodic
  std::vector<std::array<int, 3>> images_;
  std::vector<Lane4> translation_;

  void find_images(int face, const TriangleMesh &control, const std::vector<int> &stencil);
  void measure();
  void gather(int face, Lane4 *x) const override;
};

}    // namespace Membrane_NS

#endif
