/* -----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   Copyright (2003) Sandia Corporation.  Under the terms of Contract
   DE-AC04-94AL85000 with Sandia Corporation, the U.S. Government retains
   certain rights in this software.  This software is distributed under
   the GNU General Public License.

   See the README file in the top-level LAMMPS directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing author: MEMBRANE developers
------------------------------------------------------------------------- */

#include "molecules_build.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hd_bound.h"
#include "membrane_closest_point.h"
#include "membrane_molecule_output.h"
#include "membrane_molecule_reader.h"
#include "mesh_distributed.h"
#include "mesh_gather.h"
#include "platform.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <system_error>

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using namespace Membrane_NS;

static const std::vector<std::string> FORMATS = {"pdb", "cif", "gro", "psf", "data", "top"};

namespace {

/// The ranks of a simulation.
class RankTeam : public Team {
 public:
  explicit RankTeam(LAMMPS *lmp) : lmp_(lmp) {}
  int rank() const override { return lmp_->comm->me; }
  int size() const override { return lmp_->comm->nprocs; }
  std::vector<char> concatenate(const std::vector<char> &mine) override { return gather_all(mine, lmp_->world); }
  void say(const std::string &line) override
  {
    if (lmp_->comm->me == 0) utils::logmesg(lmp_, line + "\n");
  }

 private:
  LAMMPS *lmp_;
};

/// How many Angstrom the unit of length has; 0: that is not known.
double angstrom_of(const std::string &units)
{
  static const std::map<std::string, double> LENGTHS = {{"real", 1.0},  {"metal", 1.0},        {"nano", 10.0}, {"micro", 1.0e4},
                                                        {"cgs", 1.0e8}, {"electron", 0.529177210544}, {"si", 1.0e10}};
  const auto found = LENGTHS.find(units);
  return found == LENGTHS.end() ? 0.0 : found->second;
}

}    // namespace

/* ---------------------------------------------------------------------- */

void MoleculesBuild::command(int narg, char **arg)
{
  DistributedMesh &mesh = DistributedMesh::of(lmp, "membrane_build");
  parse(narg, arg);
  if (!can_read_molecules())
    error->all(FLERR, "membrane_build cannot read files of molecules, since the package was compiled without gemmi: install "
                      "gemmi-dev and tao-pegtl-dev, and compile it again");
  check_paths();

  // collective, and it leaves atoms and ghosts as they are: the next run does not notice

  mesh.update();
  TriangleMesh control = mesh.triangle_mesh();
  for (Vector3d &point : control.points) point *= angstrom;
  control.lattice *= angstrom;
  const LimitSurfaceOfMesh surface(mesh.topology(), control);
  const std::vector<MembranePart> parts = membranes(mesh);

  PatchLipids library;
  library.clash = clash;
  std::vector<Patch> patches;
  patches.reserve(LEAFLETS);
  LeafletPatches of;
  std::string message;
  std::vector<PlacedProtein> placed;
  auto read = [&](const Source &source) {
    MoleculeFile file = read_molecules(source.path);
    if (!source.psf.empty()) read_psf(source.psf, file);
    return file;
  };
  try {
    if (!patch.path.empty()) {
      patches.push_back(make_patch(read(patch), flip, neutral, library));
      of = {&patches[0], &patches[0]};
    } else
      for (int leaflet = 0; leaflet < LEAFLETS; ++leaflet) {
        patches.push_back(make_patch(read(leaflets[leaflet]), flip, neutral, library));
        of[leaflet] = &patches.back();
      }
  } catch (const MoleculeError &err) {
    message = err.what();
  }
  agree(message);
  for (const Patch &one : patches)
    for (const std::string &note : one.notes)
      if (comm->me == 0) utils::logmesg(lmp, "membrane_build: {}: {}\n", one.path, note);

  FaceComposition composition;
  if (from_lipids) composition = face_composition(mesh, parts, library);

  // proteins of one file share it

  try {
    for (const PlacedProtein &protein : place_proteins(surface)) placed.push_back(protein);
  } catch (const MoleculeError &err) {
    message = err.what();
  }
  agree(message);

  RankTeam team(lmp);
  BuildReport built;
  Structure structure;
  if (comm->me == 0) utils::logmesg(lmp, "membrane_build:\n");
  try {
    structure = build_structure(surface, Vector3d(domain->boxlo) * angstrom, parts, of, library, placed,
                                from_lipids ? &composition : nullptr, seed, team, built);
  } catch (const MoleculeError &err) {
    message = err.what();
  } catch (const std::bad_alloc &) {
    message = "not enough memory";
  }
  agree(message);
  structure.has_terms = !patch.psf.empty() || !leaflets[OUTER].psf.empty() || !leaflets[INNER].psf.empty();
  report(built, parts, library, of);
  const double charge = structure.charge();
  if (std::fabs(charge) > 0.01 && comm->me == 0)
    error->warning(FLERR, "membrane_build: the structure has a charge of {:.6g}; it needs ions", charge);

  // one writes, all fail together

  if (comm->me == 0) {
    try {
      write(structure);
    } catch (const MoleculeError &err) {
      message = err.what();
    }
  }
  agree(message);
}

/// All stop with the message of the first rank that has one.

void MoleculesBuild::agree(const std::string &message) const
{
  const std::vector<char> mine(message.begin(), message.end());
  const std::vector<char> all = gather_all(mine, world);
  if (all.empty()) return;
  int length = static_cast<int>(message.size()), longest = 0;
  MPI_Allreduce(&length, &longest, 1, MPI_INT, MPI_MAX, world);
  error->all(FLERR, "membrane_build: {}", std::string(all.begin(), all.begin() + MIN((size_t) longest, all.size())));
}

/* ---------------------------------------------------------------------- */

void MoleculesBuild::parse(int narg, char **arg)
{
  angstrom = angstrom_of(update->unit_style);
  std::string composition = "from/patch", format;
  for (int iarg = 0; iarg < narg;) {
    const std::string key = arg[iarg];
    auto need = [&](int count) {
      if (iarg + count >= narg) utils::missing_cmd_args(FLERR, "membrane_build " + key, error);
    };
    auto positive = [&](const char *word) {
      const double value = utils::numeric(FLERR, word, false, lmp);
      if (!(value > 0.0 && std::isfinite(value))) error->all(FLERR, "membrane_build {} {} must be positive", key, word);
      return value;
    };
    need(1);
    const std::string word = arg[iarg + 1];
    int used = 2;
    if (key == "patch")
      patch.path = word;
    else if (key == "psf")
      patch.psf = word;
    else if (key == "outer")
      leaflets[OUTER].path = word;
    else if (key == "inner")
      leaflets[INNER].path = word;
    else if (key == "outer/psf")
      leaflets[OUTER].psf = word;
    else if (key == "inner/psf")
      leaflets[INNER].psf = word;
    else if (key == "flip")
      flip = utils::logical(FLERR, word, false, lmp);
    else if (key == "composition")
      composition = word;
    else if (key == "seed") {
      const bigint number = utils::bnumeric(FLERR, word, false, lmp);
      if (number <= 0) error->all(FLERR, "membrane_build seed {} must be positive", word);
      seed = number;
    } else if (key == "clash")
      clash = positive(arg[iarg + 1]);
    else if (key == "neutral")
      neutral = positive(arg[iarg + 1]);
    else if (key == "scale")
      angstrom = positive(arg[iarg + 1]);
    else if (key == "membrane")
      chosen.push_back(utils::tnumeric(FLERR, word, false, lmp));
    else if (key == "protein") {
      need(2);
      proteins.push_back({word, {arg[iarg + 2], ""}});
      used = 3;
    } else if (key == "protein/psf") {
      if (proteins.empty()) error->all(FLERR, "membrane_build protein/psf must follow the protein that it is of");
      proteins.back().source.psf = word;
    } else if (key == "format")
      parse_formats(format = word);
    else if (key == "overwrite")
      overwrite = utils::logical(FLERR, word, false, lmp);
    else if (key == "out")
      name = utils::star_subst(word, update->ntimestep, 0);
    else
      error->all(FLERR,
                 "Unknown membrane_build keyword {}; known are: patch, psf, inner, outer, inner/psf, outer/psf, flip, composition, "
                 "seed, clash, neutral, scale, membrane, protein, protein/psf, format, overwrite, out",
                 key);
    iarg += used;
  }

  const bool both = !leaflets[OUTER].path.empty() && !leaflets[INNER].path.empty();
  const bool any = !leaflets[OUTER].path.empty() || !leaflets[INNER].path.empty();
  if (patch.path.empty() ? !both : any)
    error->all(FLERR, "membrane_build needs a patch, or else one of its own for each leaflet, inner and outer");
  if ((!patch.psf.empty() && patch.path.empty()) || (!both && !(leaflets[OUTER].psf + leaflets[INNER].psf).empty()))
    error->all(FLERR, "membrane_build: a PSF file without the structure that it is of");
  if (both && leaflets[OUTER].psf.empty() != leaflets[INNER].psf.empty())
    error->all(FLERR, "membrane_build: give a PSF file for both of inner and outer, or for none");
  from_lipids = composition == "from/lipids";
  if (!from_lipids && composition != "from/patch")
    error->all(FLERR, "membrane_build composition {} is not from/patch or from/lipids", composition);
  if (name.empty()) error->all(FLERR, "membrane_build needs out and a name: its files get this name and extensions");
  if (angstrom == 0.0)
    error->all(FLERR, "membrane_build does not know how long the unit of length is in units {}: say with scale how many Angstrom",
               update->unit_style);
  if (formats.empty()) formats = {"pdb", "data", "top"};
  const bool psf = !patch.psf.empty() || !leaflets[OUTER].psf.empty();
  if (psf && std::find(formats.begin(), formats.end(), "psf") == formats.end()) formats.push_back("psf");
  if (!psf && std::find(formats.begin(), formats.end(), "psf") != formats.end())
    error->all(FLERR, "membrane_build format psf needs the PSF file of the patch");
}

/// Words with commas between them.

void MoleculesBuild::parse_formats(const std::string &words)
{
  for (size_t start = 0; start <= words.size();) {
    const size_t end = std::min(words.find(',', start), words.size());
    const std::string word = words.substr(start, end - start);
    if (std::find(FORMATS.begin(), FORMATS.end(), word) == FORMATS.end())
      error->all(FLERR, "membrane_build format {} is not one of pdb, cif, gro, psf, data, top, or several with commas", word);
    if (std::find(formats.begin(), formats.end(), word) == formats.end()) formats.push_back(word);
    start = end + 1;
  }
}

std::string MoleculesBuild::path_of(const std::string &format) const
{
  return name + "." + format;
}

/// Before the work is done, not after.

void MoleculesBuild::check_paths() const
{
  std::string message;
  if (comm->me == 0)
    for (const std::string &format : formats) {
      const std::string path = path_of(format), folder = platform::path_dirname(path);
      if (std::error_code unknown; !std::filesystem::is_directory(folder, unknown))
        message = "cannot write " + path + ": there is no folder " + folder + ", create it";
      else if (!overwrite && platform::file_is_readable(path))
        message = "there is a file " + path + " already: choose another name, or overwrite yes";
      if (!message.empty()) break;
    }
  agree(message);
}

std::vector<MembranePart> MoleculesBuild::membranes(const DistributedMesh &mesh) const
{
  const Topology &topology = mesh.topology();
  if (topology.num_faces() == 0)
    error->all(FLERR, "membrane_build finds no membrane: use create_membrane or read_data");
  for (tagint molecule : chosen)
    if (std::find(mesh.molecules().begin(), mesh.molecules().end(), molecule) == mesh.molecules().end())
      error->all(FLERR, "membrane_build membrane {} does not exist; molecule IDs of membranes are {} to {}", molecule,
                 mesh.molecules().front(), mesh.molecules().back());
  std::vector<MembranePart> all(topology.num_components()), parts;
  for (int f = 0; f < topology.num_faces(); ++f) all[topology.component(topology.face(f)[0])].faces.push_back(f);
  for (int c = 0; c < topology.num_components(); ++c) {
    all[c].membrane = mesh.molecule(c);
    if (chosen.empty() || std::find(chosen.begin(), chosen.end(), mesh.molecule(c)) != chosen.end()) parts.push_back(all[c]);
  }
  return parts;
}

/* ----------------------------------------------------------------------
   A protein at each atom that a fix holds: its origin at the foot of the atom, z along the normal on the side of the
   atom's leaflet, x along the director, or without one anywhere along the surface
------------------------------------------------------------------------- */

std::vector<PlacedProtein> MoleculesBuild::place_proteins(const LimitSurface &surface) const
{
  struct Particle {
    tagint id;
    int leaflet;
    double x[3], director[3];
  };
  std::vector<PlacedProtein> placed;
  std::map<std::pair<std::string, std::string>, std::shared_ptr<const MoleculeFile>> files;
  for (const Protein &protein : proteins) {
    FixHDBound *bind = FixHDBound::named(lmp, protein.bind, "membrane_build");
    auto &file = files[{protein.source.path, protein.source.psf}];
    if (!file) {
      auto read = std::make_shared<MoleculeFile>(read_molecules(protein.source.path));
      if (!protein.source.psf.empty()) read_psf(protein.source.psf, *read);
      file = read;
    }
    std::vector<Particle> mine;
    for (int i = 0; i < atom->nlocal; ++i) {
      if (!(atom->mask[i] & bind->groupbit)) continue;
      const BoundSite &site = bind->site(i);
      Particle one = {atom->tag[i], site.bound() ? site.leaflet : 0, {}, {}};
      for (int k = 0; k < 3; ++k) {
        one.x[k] = atom->x[i][k];
        one.director[k] = site.director[k];
      }
      mine.push_back(one);
    }
    std::vector<Particle> all = gather_all(mine, world);
    std::sort(all.begin(), all.end(), [](const Particle &a, const Particle &b) { return a.id < b.id; });
    const ClosestPointFinder finder(surface);
    for (const Particle &one : all) {
      const ClosestPoint at = finder.find(angstrom * Vector3d(one.x));
      const int leaflet = one.leaflet ? one.leaflet : at.distance < 0.0 ? -1 : 1;
      const Vector3d out = leaflet * at.normal;
      Vector3d along(one.director);
      if (along.norm() == 0.0) {
        const double turn = 2.0 * M_PI * CounterRandom(seed, 2000000).uniforms(one.id, 0)[0];
        const Vector3d axis = std::fabs(out[0]) < 0.6 ? Vector3d::UnitX() : Vector3d::UnitY();
        along = Eigen::AngleAxisd(turn, out) * (axis - out * out.dot(axis));
      }
      along = (along - out * out.dot(along)).normalized();
      PlacedProtein here = {file, at.foot, Eigen::Matrix3d()};
      here.frame << along, out.cross(along), out;
      placed.push_back(here);
    }
  }
  return placed;
}

/* ---------------------------------------------------------------------- */

void MoleculesBuild::report(const BuildReport &built, const std::vector<MembranePart> &parts, const PatchLipids &library,
                            const LeafletPatches &of) const
{
  if (comm->me != 0) return;
  int total = 0;
  std::string text;
  for (size_t p = 0; p < parts.size(); ++p)
    for (int leaflet = 0; leaflet < LEAFLETS; ++leaflet) {
      int count = 0;
      std::string names;
      for (size_t s = 0; s < library.species.size(); ++s)
        if (const int number = built.numbers[p][leaflet][s]) {
          count += number;
          names += fmt::format("{}{} {}", names.empty() ? "" : ", ", number, library.species[s].name);
        }
      total += count;
      text += fmt::format("  membrane {} {} leaflet: {} lipids, {:.2f} by its area ({}), neutral surface {:.2f} from the middle\n",
                          parts[p].membrane, leaflet == OUTER ? "outer" : "inner", count, built.asked[p][leaflet], names,
                          of[leaflet]->neutral[leaflet]);
    }
  if (built.exact) text += "  planes of whole multiples of the patch: copies of it, unchanged\n";
  if (built.displaced) text += fmt::format("  lipids that made room for proteins: {}\n", built.displaced);
  text += fmt::format("  lipids in a clash, with a pair closer than {:.3g} of the closest in the patch: {} of {}, {:.2f} % (before "
                      "relaxation {:.2f} %)\n",
                      LipidCrowd::CLASH, built.clashes, total, 100.0 * built.clashes / MAX(total, 1),
                      100.0 * built.clashes_before / MAX(total, 1));
  for (const std::string &one : built.clashing) text += fmt::format("    {}\n", one);
  if (built.clashes > (int) built.clashing.size() && !built.clashing.empty()) text += "    ...\n";
  text += fmt::format("  closest pair of lipids: {:.2f} Angstrom; in the patch {:.2f}\n", built.closest, library.contacts.closest());
  bool rings = false;
  for (const LipidSpecies &species : library.species) rings |= !species.rings.empty();
  if (rings) text += fmt::format("  bonds through rings: {} undone, {} left\n", built.freed, built.pierced);
  utils::logmesg(lmp, text);
  if (built.pierced)
    error->warning(FLERR, "membrane_build: {} bonds go through rings; try another seed", built.pierced);
}

void MoleculesBuild::write(const Structure &structure)
{
  std::vector<std::unique_ptr<OutputFile>> files;
  for (const std::string &format : formats) {
    files.push_back(std::make_unique<OutputFile>(path_of(format)));
    OutputFile &file = *files.back();
    if (format == "pdb") write_pdb(file, structure);
    if (format == "cif") write_mmcif(file, structure);
    if (format == "gro") write_gro(file, structure);
    if (format == "psf") write_psf(file, structure);
    if (format == "top") write_topology(file, structure);
    if (format == "data") write_lammps_data(file, structure);
    file.finish();
  }
  std::string names;
  for (auto &file : files) {
    file->take_name();
    names += (names.empty() ? "" : ", ") + file->path();
  }
  utils::logmesg(lmp, "  wrote {} atoms of {} molecules to {}\n", structure.x.size(), structure.molecules.size(), names);
}
