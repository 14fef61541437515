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

#include "membrane_molecule_composition.h"

#include "membrane_lipid_numbers.h"

#include <algorithm>
#include <numeric>
#include <set>

using namespace Membrane_NS;
using Eigen::Vector3d;

static constexpr int BALANCES = 50;    // of numbers by face and by kind

/* ---------------------------------------------------------------------- */

std::vector<double> FaceComposition::sum(const MembranePart &part, int leaflet) const
{
  const size_t nspecies = area.size();
  std::vector<double> all(nspecies, 0.0);
  for (int f : part.faces)
    for (size_t s = 0; s < nspecies; ++s) all[s] += number[leaflet][f * nspecies + s];
  return all;
}

double FaceComposition::area_per_lipid(const std::vector<double> &sum) const
{
  return std::inner_product(sum.begin(), sum.end(), area.begin(), 0.0) / std::accumulate(sum.begin(), sum.end(), 0.0);
}

std::vector<double> FaceComposition::near(const Topology &topology, int face, int leaflet) const
{
  const size_t nspecies = area.size();
  std::set<int> faces = {face};
  for (size_t before = 0; before != faces.size();) {
    std::vector<double> here(nspecies, 0.0);
    for (int f : faces)
      for (size_t s = 0; s < nspecies; ++s) here[s] += number[leaflet][f * nspecies + s];
    if (std::accumulate(here.begin(), here.end(), 0.0) > 0.0) return here;
    before = faces.size();
    for (int f : std::vector<int>(faces.begin(), faces.end()))
      for (int v : topology.face(f)) {
        const auto &around = topology.faces_around(v);
        faces.insert(around.begin(), around.end());
      }
  }
  return std::vector<double>(nspecies, 0.0);
}

namespace {

/* ----------------------------------------------------------------------
   numbers [faces][kinds] in proportion to those given, but for a factor of each face and one of each kind, such that faces
   and kinds have these totals
------------------------------------------------------------------------- */

void balance(std::vector<double> &numbers, const std::vector<int> &of_face, const std::vector<int> &of_kind)
{
  const size_t nfaces = of_face.size(), nkinds = of_kind.size();
  for (int turn = 0; turn < BALANCES; ++turn) {
    for (size_t k = 0; k < nkinds; ++k) {
      double sum = 0.0;
      for (size_t f = 0; f < nfaces; ++f) sum += numbers[f * nkinds + k];
      for (size_t f = 0; f < nfaces && sum > 0.0; ++f) numbers[f * nkinds + k] *= of_kind[k] / sum;
    }
    for (size_t f = 0; f < nfaces; ++f) {
      const auto first = numbers.begin() + f * nkinds;
      const double sum = std::accumulate(first, first + nkinds, 0.0);
      for (size_t k = 0; k < nkinds && sum > 0.0; ++k) first[k] *= of_face[f] / sum;
    }
  }
}

}    // namespace

/* ----------------------------------------------------------------------
   each face in turn asks for what it should have, and gets the kind that is farthest behind
------------------------------------------------------------------------- */

void Membrane_NS::follow_faces(LipidCrowd &crowd, const std::vector<MembranePart> &membranes, const FaceComposition &composition,
                               const std::vector<std::array<std::vector<int>, LEAFLETS>> &wanted, int purpose)
{
  const Topology &topology = crowd.parts()[0].surface().topology();
  const size_t nspecies = composition.area.size();
  const CounterRandom random = crowd.random(purpose);
  for (size_t part = 0; part < membranes.size(); ++part)
    for (int leaflet = 0; leaflet < LEAFLETS; ++leaflet) {
      std::vector<std::vector<int>> on(topology.num_faces());
      for (size_t i = 0; i < crowd.lipids.size(); ++i)
        if (const PlacedLipid &lipid = crowd.lipids[i]; lipid.part == static_cast<int>(part) && lipid.leaflet == leaflet)
          on[lipid.point.face].push_back(static_cast<int>(i));
      std::vector<int> faces, sizes;
      std::vector<double> numbers;
      for (int f : membranes[part].faces) {
        if (on[f].empty()) continue;
        faces.push_back(f);
        sizes.push_back(static_cast<int>(on[f].size()));
        const std::vector<double> here = composition.near(topology, f, leaflet);
        numbers.insert(numbers.end(), here.begin(), here.end());
      }
      const std::vector<int> &ratio = wanted[part][leaflet];
      std::vector<int> left = largest_remainders({ratio.begin(), ratio.end()}, std::accumulate(sizes.begin(), sizes.end(), 0));
      balance(numbers, sizes, left);

      std::vector<double> behind(nspecies, 0.0);
      for (size_t n = 0; n < faces.size(); ++n) {
        std::vector<int> due(nspecies, 0);
        for (int i = 0; i < sizes[n]; ++i) {
          for (size_t s = 0; s < nspecies; ++s) behind[s] += numbers[n * nspecies + s] / sizes[n];
          int next = -1;
          for (const bool of_this_face : {true, false})    // others only where those are used up
            for (size_t s = 0; s < nspecies && (of_this_face || next < 0); ++s) {
              const bool here = numbers[n * nspecies + s] > 0.0;
              if (here == of_this_face && left[s] > 0 && (next < 0 || behind[s] > behind[next])) next = static_cast<int>(s);
            }
          --left[next];
          behind[next] -= 1.0;
          ++due[next];
        }
        std::vector<int> others;
        for (int i : on[faces[n]])
          if (int &number = due[crowd.conformer_of(i).species]; number > 0)
            --number;
          else
            others.push_back(i);
        for (size_t s = 0; s < nspecies; ++s)
          for (; due[s] > 0; --due[s]) {
            const int i = others.back();
            others.pop_back();
            PlacedLipid &lipid = crowd.lipids[i];
            const auto a = random.uniforms(static_cast<uint64_t>(i), 0);
            const auto &like = crowd.library().by_species[s];
            const ParallelPlace place = crowd.site_of(lipid);
            const Vector3d along = Eigen::AngleAxisd(2.0 * M_PI * a[0], place.normal) * (lipid.turn * Vector3d::UnitX());
            lipid = crowd.stand(place, along, like[std::min<size_t>(static_cast<size_t>(a[1] * like.size()), like.size() - 1)],
                                leaflet, static_cast<int>(part));
          }
      }
    }
}
