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

#ifndef LMP_SRD_IMPULSE_EXCHANGE_H
#define LMP_SRD_IMPULSE_EXCHANGE_H

#include "membrane_srd_events.h"
#include "membrane_srd_surface_images.h"
#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/** Makes the collisions of all ranks with one surface agree.

    Each rank works out its atoms' collisions for given impulses of others. Those that come first in
    time are right at once, and what they cause is right after one exchange more, so impulses are
    exchanged until none changes: two or three times, since few cross from rank to rank in a step.
    */
class ImpulseExchange : protected Pointers {
 public:
  /// everywhere: impulses act far from where they are, too. `user` is named in errors.
  ImpulseExchange(class LAMMPS *, const class SurfaceMotion &, bool everywhere, std::string user);

  /** Collective; call when this rank's solvent may meet other images than before: what happens to a
      vertex concerns other ranks unless only its owner's solvent comes near it. */
  void find_shared(const std::vector<Membrane_NS::SurfaceImages::Image> &images);

  /// A step begins: no impulses are known.
  void begin();
  /// Impulses from other ranks as far as they are known.
  const std::vector<Membrane_NS::SurfaceImpulse> &from_others() const { return others; }
  /// Collective: of this rank's solvent, for those from others. Returns whether any rank's have
  /// changed, and so from_others() may have; stops if that has no end.
  bool exchange(const std::vector<Membrane_NS::SurfaceImpulse> &impulses);

 private:
  const SurfaceMotion &motion;
  bool everywhere;
  std::string user;
  std::vector<char> shared;    // if not everywhere: vertices that atoms of several ranks may touch
  std::vector<Membrane_NS::SurfaceImpulse> all, others;    // as of the last exchange
  int exchanges;                                           // in this step

  std::vector<Membrane_NS::SurfaceImpulse>
  that_concern_others(const std::vector<Membrane_NS::SurfaceImpulse> &) const;
};

}    // namespace LAMMPS_NS

#endif
