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

#ifndef LMP_HELFRICH_MODEL_H
#define LMP_HELFRICH_MODEL_H

#include "helfrich_scene.h"
#include "helfrich_term.h"
#include "helfrich_term_bending.h"
#include "helfrich_term_lipids.h"
#include "membrane_mass_reference.h"
#include "mesh_exclusion.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS {

/** The energy of membranes as a sum of terms: which there are, what pair_coeff says of them, and how a
    step evaluates those that a scene has. Pair style helfrich is its user. */
class HelfrichModel : protected Pointers {
 public:
  explicit HelfrichModel(class LAMMPS *);

  // === What the user says

  void set_quadrature(Membrane_NS::Quadrature);
  Membrane_NS::Quadrature quadrature() const { return rules->quadrature(); }
  /// Room for coefficients of types 1..ntypes, all without.
  void resize(int ntypes);
  /// The words of pair_coeff after the types: kc c0 [keyword values ...].
  void set_coefficients(const std::vector<int> &types, int narg, char **arg);
  bool has_coefficients(int type) const { return bending->acts_on(type); }
  /// Whether a type has the term of this keyword.
  bool has_term(const std::string &keyword, int type) const
  {
    for (const auto &term : terms)
      if (term->keyword == keyword && term->acts_on(type)) return true;
    return false;
  }
  /// kc by type, from 1.
  std::vector<double> bending_moduli() const { return bending->moduli(); }
  /// Of the bilayer, with what its lipids add.
  double spontaneous_curvature(int type) const
  {
    return bending->spontaneous_curvature(type) + lipids->lipids().bilayer_curvature(type);
  }
  const HelfrichLipids &composition() const { return lipids->lipids(); }
  /// Coefficients of faces as they are now, for others than this; the next step takes its own anew.
  void describe_faces(const std::vector<Membrane_NS::FaceGroup> &, Membrane_NS::FaceModel &);

  // === Life cycle

  /// Collective; call from init(). Stops if atoms and coefficients do not fit.
  void init();
  const DistributedMesh &mesh() const { return *scene.mesh; }
  /// Up to date after init() if some membrane has lipids.
  const MeshOrigins &origins() const { return scene.origins; }

  // === A step

  struct Wanted {
    bool energy, virial;
    bool total_volume;    ///< if a compute may report it
  };
  /// Collective. Adds forces to owned and ghost atoms; energies and virials are below.
  void compute(const Wanted &);
  const std::vector<Membrane_NS::FaceGroup> &groups() const { return scene.groups; }
  /// If energies were wanted: of each face, and sums over this rank's.
  const HelfrichTally &energies() const { return tally; }
  /// [slots][6] xx yy zz xy xz yz, if wanted.
  const std::vector<double> &virials() const { return scene.energies.virial; }

  /// Collective: what membranes resist at their present shape.
  Membrane_NS::StiffnessReference describe();

  // === At the end of a run

  /// Collective. Warns if a finer rule sees another energy.
  void check_quadrature();

  // === Restart

  /// The rule, and what "init" stood for.
  void archive_settings(RestartArchive &);
  void archive_coefficients(RestartArchive &);

  double memory_usage() const;

 private:
  HelfrichScene scene;
  MeshExclusion exclusion;
  std::unique_ptr<Membrane_NS::PatchRules> rules, finer_rules;
  std::vector<std::unique_ptr<HelfrichTerm>> terms;
  HelfrichTermBending *bending;           // the first of them
  HelfrichTermLipids *lipids;
  std::vector<HelfrichTerm *> present;    // those this scene has
  std::vector<char> fresh;    // by type: pair_coeff was given since the last run, so "init" is now
  bool restored;              // but not the first after references came from a restart file

  HelfrichTerm::Needs needs;             // of all present terms
  std::vector<char> membrane_volume;     // whether a term needs its volume
  bool reports_volume;                   // some membrane has one, and a compute may ask for it
  bool stale;                            // local coefficients are to be found anew
  bigint lipid_stamp;                    // of those that are in the model
  std::vector<int> faces;                // owned, not excluded
  HelfrichTally tally;

  HelfrichTerm *find_term(const std::string &keyword) const;
  void check_types();
  void choose();
  void find_types();
  void check_membrane(int m);
  void localize();
  void load(const std::vector<Membrane_NS::FaceGroup> &, Membrane_NS::FaceModel &);
  bool prepare(const Wanted &);
  void measure(const Wanted &);
  void act();
  void share_volume_recoil(double (*f)[3]);
  std::vector<Eigen::Vector3d> gradient(int m, double Conjugates::*of,
                                        const std::vector<Eigen::Vector3d> &moved);
  void collect(double points);
  double bending_energy(Membrane_NS::PatchRules &);
};

}    // namespace LAMMPS_NS

#endif
