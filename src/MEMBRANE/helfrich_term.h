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

#ifndef LMP_HELFRICH_TERM_H
#define LMP_HELFRICH_TERM_H

#include "helfrich_scene.h"
#include "helfrich_words.h"
#include "pointers.h"
#include "restart_archive.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Entries of the vector that compute pair gives.
namespace HelfrichOutput {
  enum {
    BENDING,
    GAUSSIAN,
    AREA,
    VOLUME,
    TOTAL_AREA,
    TOTAL_VOLUME,
    REGULARIZATION,
    POINTS,
    AREA_DIFFERENCE,
    MEASURE,
    COUNT
  };
}

/// Energies in a step: of each face, by slot, and by entry of HelfrichOutput.
struct HelfrichTally {
  std::vector<double> face;
  double output[HelfrichOutput::COUNT];

  void add(int slot, int which, double energy)
  {
    face[slot] += energy;
    output[which] += energy;
  }
};

/// Second derivatives of the energy, in outline, to which terms add theirs.
struct HelfrichStiffness {
  std::vector<double> shear;          ///< by slot, energy: of regularize
  std::vector<double> stretch;        ///< by slot, energy/area: of local area
  std::vector<Conjugates> totals;     ///< by membrane: d2E/dA2, d2E/dV2, d2E/dM2
};

/** A term of the energy of membranes: one keyword of pair_coeff as a rule, one file
    helfrich_term_*.cpp, one line in the list of HelfrichModel.

    Most derive from TermWith, which keeps coefficients by type, and those of total area, volume or
    curvature from TermOfTotals. A term that a scene does not have is not called beyond choose(). */
class HelfrichTerm : protected Pointers {
 public:
  HelfrichTerm(class LAMMPS *lmp, std::string keyword, int output) :
      Pointers(lmp), keyword(std::move(keyword)), output(output)
  {
  }

  const std::string keyword;
  const int output;    ///< the entry of HelfrichOutput its energy counts in

  // === Coefficients, by type of control points from 1

  /// Whether pair_coeff knows the keyword; if not, others say that the term is there.
  virtual bool is_keyword() const { return true; }
  /// Room for types below n, all without this term.
  virtual void resize(int /*n*/) {}
  virtual void clear(int /*type*/) {}
  /// What pair_coeff says for these types; returns the number of words, the keyword included.
  virtual int parse(const std::vector<int> & /*types*/, const HelfrichWords &) { return 0; }
  virtual bool acts_on(int /*type*/) const { return false; }
  virtual void archive_coefficients(RestartArchive &) {}

  // === Terms of whole membranes: the same for all types of a membrane, which is excluded whole or not

  virtual bool of_whole_membrane() const { return false; }
  virtual bool same(int /*type*/, int /*other*/) const { return true; }
  virtual void archive_references(RestartArchive &) {}

  // === What the evaluation needs for it

  struct Needs {
    bool totals = false;       ///< a first pass, for the total area
    bool volume = false;       ///< and volume
    bool curvature = false;    ///< and integral of 2H
    bool gauss = false;        ///< the integral of K
    bool places = false;       ///< the model's origins in the middle of components
    bool origins = false;      ///< which membranes are those of an earlier run
    bool regularize = false;   ///< faces that regularize keeps in shape
  };
  virtual Needs needs() const { return {}; }

  // === Life cycle, in this order

  /// Collective; before a run, and when faces changed: call before acts_on() and is_in().
  virtual void choose(const HelfrichScene &) {}
  /// Whether membrane m has this term, on any of its types.
  virtual bool is_in(const HelfrichScene &scene, int m) const
  {
    const auto &types = scene.types[m];
    return std::any_of(types.begin(), types.end(), [this](int type) { return acts_on(type); });
  }
  /// Then finds what it has kept of these membranes, but not of those with `anew`; collective.
  virtual void find_references(const HelfrichScene &, const std::vector<char> & /*anew*/) {}
  /// Local coefficients, after atoms changed ranks: those of the model that this term owns.
  virtual void localize(const std::vector<Membrane_NS::FaceGroup> &, Membrane_NS::FaceModel &) {}
  /// After the first pass: takes references that were not found; collective.
  virtual void take_references(HelfrichScene &) {}
  /// Then adds its derivatives by totals to the scene's conjugates,
  virtual void act_on_membranes(HelfrichScene &) {}
  /// and then what it does to single faces to the model.
  virtual void act_on_faces(HelfrichScene &) {}
  /// After the second pass: forces besides the kernel's. x and f are [atoms][3].
  virtual void add_forces(HelfrichScene &, const double (*)[3], double (*)[3]) {}
  /// Adds what it resists, at the totals of the last step.
  virtual void add_stiffness(const HelfrichScene &, HelfrichStiffness &) {}
  /// Adds its energy, face by face.
  virtual void tally(const HelfrichScene &, HelfrichTally &) const {}
};

/// A term with a struct of coefficients, which has `bool active() const` and `archive()`.
template <class Coefficients> class TermWith : public HelfrichTerm {
 public:
  using HelfrichTerm::HelfrichTerm;

  void resize(int n) override { by_type.assign(n, Coefficients()); }
  void clear(int type) override { by_type[type] = Coefficients(); }
  int parse(const std::vector<int> &types, const HelfrichWords &words) override
  {
    Coefficients c;
    const int used = read(words, c);
    for (int type : types) by_type[type] = c;
    return used;
  }
  bool acts_on(int type) const override { return by_type[type].active(); }
  void archive_coefficients(RestartArchive &file) override
  {
    for (Coefficients &c : by_type) c.archive(file);
  }

 protected:
  std::vector<Coefficients> by_type;

  /// Returns the number of words.
  virtual int read(const HelfrichWords &, Coefficients &) const = 0;
};

/// Sum over a face's corners of a third of `coefficient(type)`, added to an array by slot.
template <class Coefficient>
void add_corner_means(const std::vector<Membrane_NS::FaceGroup> &groups, const int *type,
                      std::vector<double> &slots, const Coefficient &coefficient)
{
  for (const Membrane_NS::FaceGroup &group : groups)
    for (int s = 0; s < group.nslots(); ++s)
      for (int k = 0; k < 3; ++k)
        slots[group.first_slot + s] += coefficient(type[group.point(s, k)]) / 3.0;
}

// === The terms there are

std::unique_ptr<HelfrichTerm> make_gauss_term(class LAMMPS *);
std::unique_ptr<HelfrichTerm> make_leaflets_term(class LAMMPS *);
std::unique_ptr<HelfrichTerm> make_lipids_term(class LAMMPS *);
std::unique_ptr<HelfrichTerm> make_tension_term(class LAMMPS *);
std::unique_ptr<HelfrichTerm> make_area_term(class LAMMPS *);
std::unique_ptr<HelfrichTerm> make_area_difference_term(class LAMMPS *);
std::unique_ptr<HelfrichTerm> make_local_area_term(class LAMMPS *);
std::unique_ptr<HelfrichTerm> make_volume_term(class LAMMPS *);
std::unique_ptr<HelfrichTerm> make_pressure_term(class LAMMPS *);
std::unique_ptr<HelfrichTerm> make_regularize_term(class LAMMPS *);
std::unique_ptr<HelfrichTerm> make_measure_term(class LAMMPS *);

}    // namespace LAMMPS_NS

#endif
