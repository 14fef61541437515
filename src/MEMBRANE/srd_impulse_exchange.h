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
#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/** Makes the collisions of all ranks with one surface agree.

    Each rank works out its atoms' collisions for given impulses of others. Those that come first in
    time are right at once, and what they cause is right after one exchange more, so impulses are
    exchanged until none changes: two or three times, since few cross from rank to rank in a step.
    What acts on a mass goes to all ranks that have it, and to no other. */
class ImpulseExchange : protected Pointers {
 public:
  /// `user` is named in errors.
  ImpulseExchange(class LAMMPS *, class SurfaceMotion &, std::string user);

  /// Call when what this rank has of the surface has changed.
  void find_partners();

  /// A step begins: no impulses are known.
  void begin();
  /// Impulses from other ranks as far as they are known.
  const std::vector<Membrane_NS::SurfaceImpulse> &from_others() const { return others; }
  /// Collective: of this rank's solvent, for those from others. Returns whether any rank's have
  /// changed, and so from_others() may have; stops if that has no end.
  bool exchange(const std::vector<Membrane_NS::SurfaceImpulse> &impulses);

 private:
  SurfaceMotion &motion;
  std::string user;
  struct Partner {
    int rank;
    std::vector<Membrane_NS::SurfaceImpulse> out, in;    // vertices by numbers of the whole surface
    int sends, receives;
  };
  std::vector<Partner> partners;    // with which this rank has masses in common
  std::vector<int> partner_of;      // of a rank, or -1
  std::vector<MPI_Request> requests;
  std::vector<MPI_Status> statuses;
  std::vector<Membrane_NS::SurfaceImpulse> sent, others;    // as of the last exchange
  std::vector<char> concerned;                              // of partners
  int exchanges;                                            // in this step

  bool find_concerned(const Membrane_NS::SurfaceImpulse &);
  void add_sharers(int mass, bool &any);
  void send_and_receive();
};

}    // namespace LAMMPS_NS

#endif
