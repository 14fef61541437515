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

#ifndef LMP_MEMBRANE_LIPID_EXCHANGE_H
#define LMP_MEMBRANE_LIPID_EXCHANGE_H

#include "membrane_lipid_numbers.h"
#include "membrane_random.h"
#include "membrane_topology.h"

#include <array>
#include <cstdint>
#include <vector>

namespace Membrane_NS {

/// What an exchange asks of a lipid: area and spontaneous curvature of its monolayer.
struct ExchangedKind {
  double area, curvature;
};

/** The bending energy of a face as a function of the curvatures C of its leaflets,

      E = E0 + sum_l linear[l] C_l + sum_l quadratic[l] C_l^2/2 + cross C_outer C_inner. */
struct FaceBending {
  std::array<double, 2> linear{}, quadratic{};
  double cross = 0.0;
};

/// That of kc/2 (2H - c0)^2 with c0 = (C_outer - C_inner)/2; `curvature` is the integral of 2H.
FaceBending bilayer_bending(double kc, double area, double curvature);
/// That of kc/4 (2H_l - C_l)^2 in each leaflet; integrals over its neutral surface, 2H_l of its own outside.
FaceBending leaflet_bending(double kc, const std::array<double, 2> &area, const std::array<double, 2> &curvature);

/// Two faces that share an edge.
struct LipidEdge {
  int face[2];
};

/** Monte Carlo swaps of single lipids, doc/src/Derivation_exchange.rst: two lipids change places, and this is
    accepted with the probability min(1, exp(-dE/kT)). Numbers by kind and leaflet, and of lipids by face and
    leaflet, never change; each attempt costs a fixed number of operations. */
class LipidExchange {
 public:
  /// membrane[face] counts from 0. `empty` is the curvature of a face without lipids, by leaflet and face.
  LipidExchange(std::vector<ExchangedKind> kinds, FaceLipids lipids, std::vector<LipidEdge> edges,
                std::vector<int> membrane, std::array<std::vector<double>, 2> empty);

  /// Energies w of neighbours, [kinds][kinds], symmetric; without a call there are none.
  void set_interaction(std::vector<double> w);
  /// Of all faces, for the attempts that follow.
  void set_bending(std::vector<FaceBending> bending) { bending_ = std::move(bending); }

  // === Attempts. The same random numbers give the same swaps: use each step of them once
  // All return the sum of the energy differences of accepted swaps

  /// Between faces that share an edge, of one leaflet: edges are drawn with these weights, not negative.
  double swap_neighbors(int leaflet, int64_t attempts, const std::vector<double> &weights, double kT,
                        const CounterRandom &random);
  /// Between any two lipids of a leaflet that are of the same membrane.
  double swap_anywhere(int leaflet, int64_t attempts, double kT, const CounterRandom &random);
  /// Between the two leaflets of a face: faces are drawn with these weights.
  double swap_leaflets(int64_t attempts, const std::vector<double> &weights, double kT,
                       const CounterRandom &random);

  /// Attempts that change something, since this was made: of unlike lipids; and those accepted.
  int64_t attempted() const { return attempted_; }
  int64_t accepted() const { return accepted_; }

  // === State

  const FaceLipids &lipids() const { return lipids_; }
  const std::vector<LipidEdge> &edges() const { return edges_; }
  /// sum n a c/sum n a of a face and leaflet.
  double curvature(int leaflet, int face) const { return sums_[leaflet][face].mean; }
  /// The energy that swaps change, of all faces, anew: for checks.
  double energy() const;
  /// The part of it that pairs of lipids have.
  double interaction_energy() const;

 private:
  std::vector<ExchangedKind> kinds_;
  FaceLipids lipids_;
  std::vector<LipidEdge> edges_;
  std::vector<int> membrane_;
  std::array<std::vector<double>, 2> empty_;
  std::vector<double> w_;
  std::vector<FaceBending> bending_;
  int64_t attempted_ = 0, accepted_ = 0;

  /// Sums of a and of a c over the lipids of a face, and the face's curvature: the latter over the former.
  struct Sums {
    double area, curvature, mean;
  };
  std::array<std::vector<Sums>, 2> sums_;
  // with interactions only
  std::array<std::vector<int>, 2> numbers_;                // [faces][kinds]
  std::vector<std::array<int, 3>> around_;                 // faces across the edges of a face, or -1
  std::array<std::vector<std::array<double, 3>>, 2> contacts_;    // of pairs across those edges
  std::array<std::vector<double>, 2> inside_;              // of pairs in the face
  // with swaps anywhere only
  std::array<std::vector<int>, 2> face_of_, order_, first_;

  struct Place {
    int leaflet, face, lipid;
  };
  struct Attempt {
    Place p, q;
    double random;
  };
  void add_up();
  void list_lipids();
  bool attempt(const Place &, const Place &, double kT, double random, double &change);
  double bending_change(const Place &, const ExchangedKind &to, const ExchangedKind &from) const;
  double leaflet_change(int face, double outer, double inner) const;
  double interaction_change(const Place &, int to, int from) const;
  void move(const Place &, int to, int from);
  void fetch(const Place &) const;
  template <class Draw> double sweep(int64_t attempts, double kT, const CounterRandom &random, const Draw &draw);
};

/// The two faces of each edge of a mesh, in the order of the first's index and corner.
std::vector<LipidEdge> face_edges(const Topology &topology);

/** Length of each edge over the distance between the circumcentres of its faces, 2/(cot a + cot b) with the
    angles opposite to it: with exchange at D rho l/d lipids diffuse with D in the continuum. Bounded, since
    obtuse faces have none. `cotangents` [faces][3], of the angle opposite to the edge from corner k to k + 1. */
std::vector<double> edge_conductances(const Topology &topology, const std::vector<std::array<double, 3>> &cotangents);

}    // namespace Membrane_NS

#endif
