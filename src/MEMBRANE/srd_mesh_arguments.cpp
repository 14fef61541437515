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

#include "srd_mesh_arguments.h"

#include "domain.h"
#include "error.h"
#include "group.h"
#include "lammps.h"
#include "utils.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

using namespace LAMMPS_NS;
using Membrane_NS::BoxWalls;
using Membrane_NS::CollisionRule;

static constexpr double DEGREE = 3.14159265358979323846 / 180.0;

// faces can be cut in 4 so many times
static constexpr int MOST_LEVEL = 4;

/* ---------------------------------------------------------------------- */

static void parse_wall_velocity(LAMMPS *lmp, char **arg, BoxWalls &walls)
{
  Error *error = lmp->error;
  const std::vector<std::string> faces = {"xlo", "xhi", "ylo", "yhi", "zlo", "zhi"};
  const int f = std::find(faces.begin(), faces.end(), arg[0]) - faces.begin();
  if (f == 6)
    error->all(FLERR, "Fix srd/mesh wall/velocity {} is not xlo, xhi, ylo, yhi, zlo or zhi",
               arg[0]);
  if (lmp->domain->periodicity[f / 2])
    error->all(FLERR, "Fix srd/mesh wall/velocity {}: the box is periodic there, without wall",
               arg[0]);
  for (int k = 0; k < 3; ++k) walls.velocity[f][k] = utils::numeric(FLERR, arg[1 + k], false, lmp);
  if (walls.velocity[f][f / 2] != 0.0)
    error->all(FLERR, "Fix srd/mesh wall/velocity {}: a wall can move along itself only", arg[0]);
}

/* ---------------------------------------------------------------------- */

SRDMeshArguments SRDMeshArguments::parse(LAMMPS *lmp, int narg, char **arg)
{
  Error *error = lmp->error;
  SRDMeshArguments given;
  if (narg < 8) utils::missing_cmd_args(FLERR, "fix srd/mesh", error);
  auto positive = [&](const char *what, const char *word) {
    const double value = utils::numeric(FLERR, word, false, lmp);
    if (!(value > 0.0)) error->all(FLERR, "Fix srd/mesh {} {} must be positive", what, word);
    return value;
  };
  auto positive_integer = [&](const char *what, const char *word) {
    const bigint value = utils::bnumeric(FLERR, word, false, lmp);
    if (value <= 0) error->all(FLERR, "Fix srd/mesh {} {} must be positive", what, word);
    return value;
  };

  given.every = utils::inumeric(FLERR, arg[3], false, lmp);
  if (given.every <= 0) error->all(FLERR, "Fix srd/mesh N {} must be positive", arg[3]);
  if (strcmp(arg[4], "NULL") != 0) {
    given.membranes = lmp->group->find(arg[4]);
    if (given.membranes < 0)
      error->all(FLERR, "Fix srd/mesh: there is no group {} of membranes; NULL is for none",
                 arg[4]);
  }
  given.temperature = positive("temperature", arg[5]);
  given.cells.size = positive("hgrid", arg[6]);
  given.seed = given.cells.rule.seed = positive_integer("seed", arg[7]);

  int iarg = 8;
  while (iarg < narg) {
    const std::string key = arg[iarg];
    auto need = [&](int n) {
      if (iarg + n >= narg) utils::missing_cmd_args(FLERR, "fix srd/mesh " + key, error);
    };
    auto choice = [&](const std::vector<std::string> &words) {
      const auto found = std::find(words.begin(), words.end(), arg[iarg + 1]);
      if (found == words.end()) {
        std::string list = words[0];
        for (size_t i = 1; i < words.size(); ++i)
          list += (i + 1 == words.size() ? " or " : ", ") + words[i];
        error->all(FLERR, "Fix srd/mesh {} {} is not {}", key, arg[iarg + 1], list);
      }
      return found - words.begin();
    };
    need(1);
    const char *word = arg[iarg + 1];
    int used = 2;
    if (key == "lamda") {
      given.lamda = positive("lamda", word);
    } else if (key == "angle") {
      const double degrees = utils::numeric(FLERR, word, false, lmp);
      if (!(degrees > 0.0 && degrees <= 180.0))
        error->all(FLERR, "Fix srd/mesh angle {} must be between 0 and 180 degrees", word);
      given.cells.rule.angle = DEGREE * degrees;
    } else if (key == "method") {
      given.cells.rule.method = choice({"srd", "at+a"}) ? CollisionRule::Method::AT_A
                                                        : CollisionRule::Method::SRD;
    } else if (key == "collision") {
      given.noslip = choice({"slip", "noslip"}) == 1;
    } else if (key == "impulse") {
      given.control = choice({"surface", "control"}) == 1;
    } else if (key == "inside") {
      given.inside = static_cast<Inside>(choice({"error", "warn", "ignore"}));
    } else if (key == "level") {
      given.level = utils::inumeric(FLERR, word, false, lmp);
      if (given.level < 0 || given.level > MOST_LEVEL)
        error->all(FLERR, "Fix srd/mesh level {} is not between 0 and {}", word, MOST_LEVEL);
    } else if (key == "bounce") {
      given.bounces = utils::inumeric(FLERR, word, false, lmp);
      if (given.bounces < 0) error->all(FLERR, "Fix srd/mesh bounce {} must not be negative", word);
    } else if (key == "search") {
      given.search = positive("search", word);
    } else if (key == "cubic") {
      need(2);
      used = 3;
      given.cubic_error = choice({"error", "warn"}) == 0;
      given.cubic_tolerance = utils::numeric(FLERR, arg[iarg + 2], false, lmp);
      if (given.cubic_tolerance < 0.0 || given.cubic_tolerance > 1.0)
        error->all(FLERR, "Fix srd/mesh cubic tolerance {} must be between 0 and 1", arg[iarg + 2]);
    } else if (key == "shift") {
      given.shift = static_cast<Shift>(choice({"no", "yes", "possible"}));
      if (given.shift == Shift::NO && (iarg + 2 >= narg || !utils::is_integer(arg[iarg + 2]))) {
        iarg += 2;    // a grid that stays needs no seed
        continue;
      }
      need(2);
      used = 3;
      given.cells.shift_seed = positive_integer("shift seed", arg[iarg + 2]);
    } else if (key == "tstat") {
      given.cells.rule.thermostat = utils::logical(FLERR, word, false, lmp);
    } else if (key == "velocity") {
      given.set_velocities = choice({"keep", "create"}) == 1;
    } else if (key == "ghosts") {
      given.ghosts = utils::logical(FLERR, word, false, lmp);
    } else if (key == "measure") {
      given.measure = utils::logical(FLERR, word, false, lmp);
    } else if (key == "wall") {
      given.walls.noslip = choice({"slip", "noslip"}) == 1;
    } else if (key == "wall/velocity") {
      need(4);
      used = 5;
      parse_wall_velocity(lmp, arg + iarg + 1, given.walls);
    } else
      error->all(FLERR,
                 "Unknown fix srd/mesh keyword {}; known are: lamda, angle, method, collision, "
                 "impulse, level, inside, bounce, search, cubic, shift, tstat, velocity, "
                 "ghosts, measure, wall, wall/velocity",
                 key);
    iarg += used;
  }
  if (given.control && given.level > 0)
    error->all(
        FLERR,
        "Fix srd/mesh impulse control acts on the triangles between vertices: leave out level");
  if (given.cells.rule.method == CollisionRule::Method::AT_A && given.cells.rule.thermostat)
    error->all(FLERR, "Fix srd/mesh method at+a is a thermostat: leave out tstat yes");
  return given;
}
