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
#include "error.h"
#include "force.h"
#include "helfrich_lipids.h"
#include "mesh_distributed.h"
#include "mesh_lipid_places.h"
#include "modify.h"
#include "pair.h"

#include <algorithm>
#include <numeric>

using namespace LAMMPS_NS;
using Eigen::Vector3d;
using namespace Membrane_NS;

/* ----------------------------------------------------------------------
   The single lipids that fix hd/lipids has on faces, or else the compositions of pair_coeff: of a face, a third of each
   corner's, as many as fit on the flat face
------------------------------------------------------------------------- */

FaceComposition MoleculesBuild::face_composition(const DistributedMesh &mesh, const std::vector<MembranePart> &parts,
                                                 const PatchLipids &library) const
{
  const Topology &topology = mesh.topology();
  const LipidPlaces *places = LipidPlaces::on(mesh, modify);
  int dim;
  Pair *pair = force->pair_match("helfrich", 1);
  const auto said = pair ? static_cast<const HelfrichLipids *>(pair->extract("lipids", dim)) : nullptr;
  if (!places && !said)
    error->all(FLERR, "membrane_build composition from/lipids: no membrane has lipids; say lipids in pair_coeff, or take from/patch");

  std::vector<int> mine(topology.num_vertices(), 0), types(mine.size());
  for (int i = 0; i < atom->nlocal; ++i)
    if (const int v = mesh.vertex(atom->tag[i]); v >= 0) mine[v] = atom->type[i];
  MPI_Allreduce(mine.data(), types.data(), static_cast<int>(mine.size()), MPI_INT, MPI_MAX, world);

  FaceComposition composition;
  const size_t nspecies = library.species.size();
  composition.area.assign(nspecies, 0.0);
  for (auto &number : composition.number) number.assign(topology.num_faces() * nspecies, 0.0);
  auto add = [&](int leaflet, int face, const LipidKind &kind, double number) {
    const auto species = std::find_if(library.species.begin(), library.species.end(),
                                      [&](const LipidSpecies &one) { return one.name == kind.name; });
    if (species == library.species.end()) {
      std::string names;
      for (const LipidSpecies &one : library.species) names += (names.empty() ? "" : ", ") + one.name;
      error->all(FLERR, "membrane_build composition from/lipids: no patch has the lipid {}; they have: {}", kind.name, names);
    }
    const size_t s = species - library.species.begin();
    composition.area[s] = kind.area * angstrom * angstrom;
    composition.number[leaflet][face * nspecies + s] += number;
  };
  const TriangleMesh control = mesh.triangle_mesh();
  for (const MembranePart &part : parts)
    for (int leaflet = 0; leaflet < LEAFLETS; ++leaflet) {
      const int which = leaflet == OUTER ? 0 : 1;
      for (int f : part.faces) {
        if (places)
          for (int k = 0; k < static_cast<int>(places->kinds.size()); ++k)
            if (const int number = places->count(which, f, k)) add(leaflet, f, places->kinds[k], number);
        if (places || !said) continue;
        const Face &face = topology.face(f);
        const Vector3d a = control.nearest_image(control.points[face[1]] - control.points[face[0]]);
        const Vector3d b = control.nearest_image(control.points[face[2]] - control.points[face[0]]);
        for (int v : face) {
          const auto &leaflets = said->of(types[v]);
          const auto &made_of = which == 0 ? leaflets.outer : leaflets.inner;
          for (const auto &[kind, fraction] : made_of.parts)
            add(leaflet, f, said->library()[kind], fraction * a.cross(b).norm() / (6.0 * made_of.area(said->library())));
        }
      }
      const std::vector<double> sum = composition.sum(part, leaflet);
      if (std::accumulate(sum.begin(), sum.end(), 0.0) == 0.0)
        error->all(FLERR, "membrane_build composition from/lipids: membrane {} has no lipids; say lipids in pair_coeff, and let "
                          "fix hd/lipids, if there is one, have its control points", part.membrane);
    }
  if (comm->me == 0)
    utils::logmesg(lmp, "membrane_build: lipids are those of {}\n", places ? "fix hd/lipids" : "pair_coeff");
  return composition;
}
