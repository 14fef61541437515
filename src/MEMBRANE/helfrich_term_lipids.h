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

#ifndef LMP_HELFRICH_TERM_LIPIDS_H
#define LMP_HELFRICH_TERM_LIPIDS_H

#include "helfrich_lipids.h"
#include "helfrich_term.h"

namespace LAMMPS_NS {

/** What lipids add to the spontaneous curvatures of bending and leaflets: the mean of a composition, or what
    MeshLipids says of each face. The energy of the flat membrane of that composition is taken away, kc c0^2/2 per
    area of a bilayer: it belongs to the lipids, whose number does not change with the area. It counts as bending. */
class HelfrichTermLipids : public HelfrichTerm {
 public:
  explicit HelfrichTermLipids(class LAMMPS *);

  const HelfrichLipids &lipids() const { return said; }

  void resize(int n) override { said.resize(n); }
  void clear(int type) override;
  int parse(const std::vector<int> &types, const HelfrichWords &words) override;
  bool acts_on(int type) const override { return said.of(type).given; }
  void archive_coefficients(RestartArchive &file) override { said.archive(file); }

  Needs needs() const override
  {
    Needs needs;
    needs.origins = true;    // of lipids on faces, which fix hd/lipids keeps
    return needs;
  }

  void choose(const HelfrichScene &) override;
  void localize(const std::vector<Membrane_NS::FaceGroup> &, Membrane_NS::FaceModel &) override;
  void act_on_faces(HelfrichScene &) override;
  void tally(const HelfrichScene &, HelfrichTally &) const override;

 private:
  HelfrichLipids said;
  std::vector<char> unlogged;    // by type
  const MeshLipids *on_faces;
  int nfaces;
  std::vector<double> flat;    // by slot: energy of the flat membrane per area

  void log(const std::vector<Membrane_NS::FaceGroup> &, const Membrane_NS::FaceModel &);
};

}    // namespace LAMMPS_NS

#endif
