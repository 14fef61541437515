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

#include "atom_vec_membrane_cp.h"

#include "atom.h"
#include "error.h"
#include "force.h"
#include "mesh_angle_style.h"

#include <cmath>
#include <cstring>
#include <deque>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   LAMMPS knows a per-atom array by its name and the address of the pointer to it. Atom style hybrid frees
   arrays after the sub-styles that these pointers would be in, so they stay until the program ends; and
   an atom style that takes the place of another, as in read_restart, finds the first one's address in the list
------------------------------------------------------------------------- */

static constexpr char ORIGIN[] = "membrane_origin";

static bigint *&lasting_pointer(Atom *atom)
{
  for (const auto &known : atom->peratom)
    if (known.name == ORIGIN) return *static_cast<bigint **>(known.address);
  static auto &all = *new std::deque<bigint *>;
  all.push_back(nullptr);
  atom->add_peratom(ORIGIN, &all.back(), Atom::BIGINT, 0);
  return all.back();
}

/* ---------------------------------------------------------------------- */

AtomVecMembraneCP::AtomVecMembraneCP(LAMMPS *lmp) :
    AtomVec(lmp), AtomVecAngle(lmp), rmass(nullptr), origin(lasting_pointer(atom)),
    surface(std::make_shared<DistributedMesh>(lmp))
{
  mass_type = PER_ATOM;
  atom->rmass_flag = 1;

  for (auto *fields : {&fields_grow, &fields_copy, &fields_border, &fields_border_vel,
                       &fields_exchange, &fields_restart, &fields_create})
    fields->emplace_back("rmass");

  // unlike masses, origins of ghost atoms are of no use

  for (auto *fields :
       {&fields_grow, &fields_copy, &fields_exchange, &fields_restart, &fields_create})
    fields->emplace_back(ORIGIN);
  fields_data_atom = {"id", "molecule", "type", "rmass", "x"};

  // the base class has done it for its own fields, and LAMMPS before 2026 forgets these flags

  delete[] threads;
  threads = nullptr;
  setup_fields();
}

/* ----------------------------------------------------------------------
   optional argument: which angle types are faces
------------------------------------------------------------------------- */

void AtomVecMembraneCP::process_args(int narg, char **arg)
{
  set_angle_style_of_faces(lmp);
  if (narg == 0) return;
  if (narg != 2 || strcmp(arg[0], "faces") != 0)
    error->all(FLERR, "Unknown atom_style membrane_cp argument {}; the only one is: faces TYPES",
               arg[0]);
  surface->set_face_types(arg[1]);
}

/* ----------------------------------------------------------------------
   follows Force::init(), where pair helfrich sets the angle style each time
------------------------------------------------------------------------- */

void AtomVecMembraneCP::init()
{
  AtomVecAngle::init();
  if (force->pair_match("helfrich", 1)) unset_angle_style_of_faces(lmp);
}

void AtomVecMembraneCP::grow_pointers()
{
  AtomVecAngle::grow_pointers();
  rmass = atom->rmass;
}

void AtomVecMembraneCP::create_atom_post(int ilocal)
{
  rmass[ilocal] = 1.0;
}

void AtomVecMembraneCP::data_atom_post(int ilocal)
{
  AtomVecAngle::data_atom_post(ilocal);
  origin[ilocal] = 0;
  if (!(rmass[ilocal] > 0.0) || !std::isfinite(rmass[ilocal]))
    error->one(FLERR,
               "Atom {} in the Atoms section of the data file has mass {}; columns are: "
               "id molecule type mass x y z, and masses must be positive",
               atom->tag[ilocal], rmass[ilocal]);
}
