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

#ifndef LMP_HD_FACE_WATCH_H
#define LMP_HD_FACE_WATCH_H

#include "mesh_local.h"

#include <array>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/** Notices in a run that a face of the control mesh collapses or turns over, which is how the mesh
    of a fluid membrane ends: warns, and stops the run unless the mesh soon recovers. Faces are
    judged by Membrane_NS::face_uprightness against what they were when the run began: meshes that
    are stretched or coarse from the start are left alone. */
class FaceWatch : protected Pointers {
 public:
  /// `user` is named in the error.
  FaceWatch(class LAMMPS *, int groupbit, std::string user);

  /// Steps for which a run goes on while there is such a face.
  bigint patience;

  /// Collective; call from init().
  void init();
  /// Collective; at the start of a run, when coordinates of ghosts are those of this step. A run
  /// that continues the last one goes by the start of that.
  void begin();
  /// Every step, likewise: looks at this rank's faces if that is due.
  void check(bool due);
  /// Remembers edges before a step, when ghosts are where they belong.
  void hold();
  /** Collective; when control points have moved since and ghosts have not: whether check() would warn of a face, or an
      edge has changed by its own length or more. Forth and back such a step is the same. */
  bool torn();
  double memory_usage() const;

 private:
  // local indices of the corners, and of the far corners of the faces across its edges

  struct Watched {
    int face;
    int corner[3], across[3];
  };

  int groupbit;
  std::string user;
  LocalMesh mesh;
  bool judged;         // the faces of this topology: `least` is theirs
  bigint last_step;    // of the last check
  bigint bad_since;    // when faces of this rank became bad, or -1
  bool warned;
  std::vector<Watched> faces;
  std::vector<std::array<double, 9>> held;    // edges of these
  std::vector<double> least;    // by face of the topology: what it must not fall below

  void localize();
  void judge_start();
  double uprightness(const Watched &) const;
  std::array<double, 9> edges(const Watched &) const;
};

}    // namespace LAMMPS_NS

#endif
