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

#ifdef FIX_CLASS
// clang-format off
FixStyle(hd/lipids,FixHDLipids);
// clang-format on
#else

#ifndef LMP_FIX_HD_LIPIDS_H
#define LMP_FIX_HD_LIPIDS_H

#include "fix.h"
#include "membrane_lipid_exchange.h"
#include "membrane_quadrature.h"
#include "mesh_lipid_places.h"
#include "mesh_local.h"
#include "restart_archive.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/** Single lipids on the faces of membranes, and their Monte Carlo exchange. All ranks have all lipids and do the
    same swaps; what depends on the shape comes from the rank that has the face. The weights are derived in
    doc/src/Derivation_exchange.rst. */
class FixHDLipids : public Fix {
 public:
  FixHDLipids(class LAMMPS *, int, char **);
  ~FixHDLipids() override;

  int setmask() override;
  void init() override;
  void setup_pre_force(int) override;
  void pre_force(int) override;

  /// Minus the energy that swaps have given to the membranes.
  double compute_scalar() override;
  /// Attempts that swap unlike lipids, part of them that was accepted, visits.
  double compute_vector(int) override;
  /// "places": a LipidPlaces.
  void *extract(const char *, int &) override;
  double memory_usage() override;
  void write_restart(FILE *) override;
  void restart(char *) override;

 private:
  // words
  double temperature, diffusion, anywhere, flips;
  bigint seed;
  struct Interaction {
    std::string first, second;
    double energy;
  };
  std::vector<Interaction> interactions;

  // the mesh and what pair_coeff says
  LocalMesh mesh;
  class HelfrichModel *model;
  const class HelfrichLipids *composition;
  std::unique_ptr<Membrane_NS::PatchRules> rules;
  Membrane_NS::FaceGroups groups;
  std::vector<int> types;                // by vertex
  std::vector<char> takes_part;          // by membrane
  std::vector<int> membrane_of;          // by face
  std::vector<double> base_outer, base_inner, distance, kc;    // by slot: without lipids

  /// What the exchange asks of the shape of a face.
  struct FaceShape {
    int face = 0;
    std::array<double, 2> area{};    // of neutral surfaces
    double middle = 0.0;             // area of the mid-plane
    Membrane_NS::FaceBending bending;
    std::array<double, 3> cotangents{};    // opposite to the edge from corner k to k + 1
  };
  std::vector<FaceShape> shapes;    // by face, of the last call of measure()

  // lipids, while faces stay
  std::unique_ptr<Membrane_NS::LipidExchange> exchange;
  bool warned;       // that an integrator has another temperature
  bool published;    // to the mesh
  bool filled;
  LipidPlaces places;

  // lipids as they go through restarts and changes of the mesh: by the origins of a face's corners, increasing
  struct KeptFace {
    std::array<bigint, 3> corners{};
    std::array<int, 3> types{};           // of these corners, in their order
    std::array<std::string, 2> lipids;    // kinds, in the order of their numbers
    bool operator<(const KeptFace &o) const { return corners < o.corners; }
    void archive(RestartArchive &file)
    {
      for (bigint &corner : corners) file(corner);
      for (int &type : types) file(type);
      for (std::string &leaflet : lipids) file(leaflet);
    }
  };
  std::vector<KeptFace> kept;
  std::vector<KeptFace> keys;               // by face, without lipids: as they were when these were put there
  std::vector<const KeptFace *> found;      // by face, those of its lipids
  std::vector<char> anew;                   // by membrane: takes part, and has none that were kept
  std::vector<std::string> kept_kinds;    // their names, by number
  std::vector<std::string> kept_words;    // by type: the composition they were made of

  bigint visits, last_visit, attempted, accepted;
  double energy;

  void parse(int narg, char **arg);
  void check_surroundings();
  void find_membranes();
  std::string words_of(int type) const;
  void find_kept();
  void take_up();
  std::array<std::vector<double>, 2> free_areas() const;
  void start(Membrane_NS::FaceLipids);
  void keep();
  void follow_origins();
  std::array<int, 3> sorted_corners(int face, const std::vector<bigint> &origins) const;
  KeptFace key_of(int face, const std::vector<bigint> &origins) const;
  double composed(int face, int leaflet) const;

  void follow();
  void measure();
  void publish();
  void visit();
  int64_t attempts(double mean, int which) const;
  void archive(RestartArchive &);
};

}    // namespace LAMMPS_NS

#endif
#endif
