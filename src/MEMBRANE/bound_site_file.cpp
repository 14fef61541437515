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

#include "bound_site_file.h"

#include "comm.h"
#include "error.h"
#include "mesh_gather.h"
#include "tokenizer.h"

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

using namespace LAMMPS_NS;

// of the sum of barycentric coordinates from 1
static constexpr double SUM = 1.0e-6;

/* ---------------------------------------------------------------------- */

static SiteOfAtom parse_line(const std::vector<std::string> &words, LAMMPS *lmp, const std::string &where)
{
  Error *error = lmp->error;
  const size_t n = words.size();
  if (n != 7 && n != 8 && n != 9 && n != 12)
    error->all(FLERR, "{} has {} words: it must be atom ID, three corners, three barycentric coordinates, and if "
                      "wanted leaflet, distance and three components of a director", where, n);
  auto id = [&](int k) {
    if (!utils::is_integer(words[k]))
      error->all(FLERR, "{}: {} is not an atom ID", where, words[k]);
    return utils::tnumeric(FLERR, words[k], false, lmp);
  };
  auto number = [&](int k) {
    const double value = utils::is_double(words[k]) ? utils::numeric(FLERR, words[k], false, lmp) : NAN;
    if (!std::isfinite(value)) error->all(FLERR, "{}: {} is not a number", where, words[k]);
    return value;
  };
  SiteOfAtom out;
  out.atom = id(0);
  double b[3];
  for (int k = 0; k < 3; ++k) {
    out.site.corner[k] = id(1 + k);
    b[k] = number(4 + k);
    if (b[k] < 0.0) error->all(FLERR, "{}: the barycentric coordinate {} is negative", where, words[4 + k]);
  }
  if (std::fabs(b[0] + b[1] + b[2] - 1.0) > SUM)
    error->all(FLERR, "{}: barycentric coordinates sum to {:.8g}, not to 1", where, b[0] + b[1] + b[2]);
  out.site.point.u = b[1];
  out.site.point.v = b[2];
  if (n > 7) {
    if (words[7] != "in" && words[7] != "out")
      error->all(FLERR, "{}: leaflet {} is not in or out", where, words[7]);
    out.site.leaflet = words[7] == "in" ? -1 : 1;
  }
  if (n > 8) {
    out.site.distance = number(8);
    out.has_distance = true;
  }
  if (n == 12)
    for (int k = 0; k < 3; ++k) out.site.director[k] = number(9 + k);
  return out;
}

std::vector<SiteOfAtom> BoundSiteFile::read(LAMMPS *lmp, const std::string &path)
{
  std::vector<char> mine;
  int found = 1;
  if (lmp->comm->me == 0) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    found = file.is_open() && !file.bad();
    const std::string all = text.str();
    mine.assign(all.begin(), all.end());
  }
  MPI_Bcast(&found, 1, MPI_INT, 0, lmp->world);
  if (!found) lmp->error->all(FLERR, "Fix hd/bind cannot read the file of sites {}", path);
  const std::vector<char> all = gather_all(mine, lmp->world);

  std::istringstream text(std::string(all.begin(), all.end()));
  std::vector<SiteOfAtom> sites;
  std::set<tagint> atoms;
  std::string line;
  for (int n = 1; std::getline(text, line); ++n) {
    const auto words = Tokenizer(utils::trim_comment(line)).as_vector();
    if (words.empty()) continue;
    const std::string where = fmt::format("Fix hd/bind sites {}, line {}", path, n);
    sites.push_back(parse_line(words, lmp, where));
    sites.back().line = n;
    if (!atoms.insert(sites.back().atom).second)
      lmp->error->all(FLERR, "{}: atom {} has had its site before", where, sites.back().atom);
  }
  return sites;
}

void BoundSiteFile::write(LAMMPS *lmp, const std::string &path, const std::vector<SiteOfAtom> &sites)
{
  FILE *file = fopen(path.c_str(), "w");
  if (!file) lmp->error->one(FLERR, "write_bound cannot open {}: {}", path, utils::getsyserror());
  fmt::print(file, "# atom, corners of its face, barycentric coordinates, leaflet, distance, director\n");
  for (const auto &[atom, site, has_distance, line] : sites) {
    const auto b = site.point.barycentric();
    fmt::print(file, "{} {} {} {} {:.17g} {:.17g} {:.17g} {} {:.17g}", atom, site.corner[0], site.corner[1],
               site.corner[2], b[0], b[1], b[2], site.leaflet < 0 ? "in" : "out", site.distance);
    const double *t = site.director;
    if (t[0] != 0.0 || t[1] != 0.0 || t[2] != 0.0)
      fmt::print(file, " {:.17g} {:.17g} {:.17g}", t[0], t[1], t[2]);
    fmt::print(file, "\n");
  }
  const bool bad = ferror(file);
  if (fclose(file) || bad) lmp->error->one(FLERR, "write_bound cannot write {}: {}", path, utils::getsyserror());
}
