/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

// Registers every style of the package with a LAMMPS that was built without it.
// There is no list of styles to keep: the build writes membrane_styles.h, which includes
// each style's header, and the headers' own PairStyle(key,Class) lines do the rest.

#include "lammpsplugin.h"
#include "version.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "output.h"
#include "update.h"

#include "membrane_styles.h"

#include <cstring>

using namespace LAMMPS_NS;

namespace {

// === How LAMMPS creates a style

template <class Base, class Style> Base *create(LAMMPS *lmp)
{
  return new Style(lmp);
}

template <class Base, class Style> Base *create_with_args(LAMMPS *lmp, int narg, char **arg)
{
  return new Style(lmp, narg, arg);
}

// the loader's untyped versions of the two; LAMMPS takes the result for a Base *

template <class Base, class Style> void *create_untyped(void *lmp)
{
  return create<Base, Style>(static_cast<LAMMPS *>(lmp));
}

template <class Base, class Style> void *create_untyped_with_args(void *lmp, int narg, char **arg)
{
  return create_with_args<Base, Style>(static_cast<LAMMPS *>(lmp), narg, arg);
}

// === Kinds that LAMMPS' plugin loader knows

class Loader {
 public:
  Loader(void *lmp, void *handle, void *regfunc) :
      lmp(lmp), add_to_lammps(reinterpret_cast<lammpsplugin_regfunc>(regfunc)), plugin()
  {
    plugin.version = LAMMPS_VERSION;
    plugin.author = "the MEMBRANE developers";
    plugin.handle = handle;
  }

  void add(const char *kind, const char *name, const char *info, lammpsplugin_factory1 *creator)
  {
    plugin.creator.v1 = creator;
    add(kind, name, info);
  }

  void add(const char *kind, const char *name, const char *info, lammpsplugin_factory2 *creator)
  {
    plugin.creator.v2 = creator;
    add(kind, name, info);
  }

 private:
  void *lmp;
  lammpsplugin_regfunc add_to_lammps;
  lammpsplugin_t plugin;

  void add(const char *kind, const char *name, const char *info)
  {
    plugin.style = kind;
    plugin.name = name;
    plugin.info = info;
    add_to_lammps(&plugin, lmp);
  }
};

void add_loadable_styles(Loader &loader)
{
#define PAIR_CLASS
#define PairStyle(key, Class) \
  loader.add("pair", #key, "MEMBRANE pair style " #key, &create_untyped<Pair, Class>)
#include "membrane_styles.h"
#undef PairStyle
#undef PAIR_CLASS

#define ANGLE_CLASS
#define AngleStyle(key, Class) \
  loader.add("angle", #key, "MEMBRANE angle style " #key, &create_untyped<Angle, Class>)
#include "membrane_styles.h"
#undef AngleStyle
#undef ANGLE_CLASS

#define COMMAND_CLASS
#define CommandStyle(key, Class) \
  loader.add("command", #key, "MEMBRANE command " #key, &create_untyped<Command, Class>)
#include "membrane_styles.h"
#undef CommandStyle
#undef COMMAND_CLASS

#define FIX_CLASS
#define FixStyle(key, Class) \
  loader.add("fix", #key, "MEMBRANE fix style " #key, &create_untyped_with_args<Fix, Class>)
#include "membrane_styles.h"
#undef FixStyle
#undef FIX_CLASS

#define COMPUTE_CLASS
#define ComputeStyle(key, Class) \
  loader.add("compute", #key, "MEMBRANE compute style " #key, &create_untyped_with_args<Compute, Class>)
#include "membrane_styles.h"
#undef ComputeStyle
#undef COMPUTE_CLASS

#define REGION_CLASS
#define RegionStyle(key, Class) \
  loader.add("region", #key, "MEMBRANE region style " #key, &create_untyped_with_args<Region, Class>)
#include "membrane_styles.h"
#undef RegionStyle
#undef REGION_CLASS
}

// === Kinds that it does not know: straight into LAMMPS' own tables

void add_other_styles(LAMMPS *lmp)
{
#define ATOM_CLASS
#define AtomStyle(key, Class) (*lmp->atom->avec_map)[#key] = &create<AtomVec, Class>
#include "membrane_styles.h"
#undef AtomStyle
#undef ATOM_CLASS

#define DUMP_CLASS
#define DumpStyle(key, Class) (*lmp->output->dump_map)[#key] = &create_with_args<Dump, Class>
#include "membrane_styles.h"
#undef DumpStyle
#undef DUMP_CLASS

#define MINIMIZE_CLASS
#define MinimizeStyle(key, Class) (*lmp->update->minimize_map)[#key] = &create<Min, Class>
#include "membrane_styles.h"
#undef MinimizeStyle
#undef MINIMIZE_CLASS
}

bool has_package(LAMMPS *lmp)
{
  return lmp->atom->avec_map->count("membrane_cp") > 0;
}

}    // namespace

extern "C" void lammpsplugin_init(void *ptr, void *handle, void *regfunc)
{
  auto *lmp = static_cast<LAMMPS *>(ptr);

  if (has_package(lmp)) {
    if (lmp->comm->me == 0)
      utils::logmesg(lmp, "This LAMMPS has the MEMBRANE package already: nothing to load\n");
    return;
  }

  // A class compiled for another LAMMPS has another layout: that would crash, not fail.
  if (strcmp(lmp->version, LAMMPS_VERSION) != 0)
    lmp->error->all(FLERR,
                    "membraneplugin.so was compiled for LAMMPS version {}, and this is version {}: "
                    "compile it with the source of this LAMMPS",
                    LAMMPS_VERSION, lmp->version);

  Loader loader(ptr, handle, regfunc);
  add_loadable_styles(loader);
  add_other_styles(lmp);
}
