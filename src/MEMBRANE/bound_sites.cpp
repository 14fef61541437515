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

#include "bound_sites.h"

#include "mesh_faces.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

int BoundSites::pack(int i, double *buf) const
{
  const BoundSite &site = sites[i];
  int n = 0;
  for (tagint id : site.corner) buf[n++] = ubuf(id).d;
  buf[n++] = ubuf(site.point.face).d;
  buf[n++] = site.point.u;
  buf[n++] = site.point.v;
  buf[n++] = site.distance;
  buf[n++] = site.leaflet;
  for (double d : site.director) buf[n++] = d;
  for (double d : site.normal) buf[n++] = d;
  buf[n++] = site.pull;
  return n;
}

int BoundSites::unpack(int i, const double *buf)
{
  BoundSite &site = sites[i];
  int n = 0;
  for (tagint &id : site.corner) id = (tagint) ubuf(buf[n++]).i;
  site.point.face = (int) ubuf(buf[n++]).i;
  site.point.u = buf[n++];
  site.point.v = buf[n++];
  site.distance = buf[n++];
  site.leaflet = static_cast<int>(buf[n++]);
  for (double &d : site.director) d = buf[n++];
  for (double &d : site.normal) d = buf[n++];
  site.pull = buf[n++];
  return n;
}

/* ---------------------------------------------------------------------- */

void LAMMPS_NS::find_again(const MeshFaces &mesh, BoundSite &site)
{
  const auto weight = site.point.barycentric();
  site.point = {};
  const int v = mesh.vertex(site.corner[0]);
  if (v < 0) return;
  for (int f : mesh.topology().faces_around(v)) {
    tagint corner[3];
    double here[3];
    int same = 0;
    for (int k = 0; k < 3; ++k) {
      corner[k] = mesh.tag(mesh.topology().face(f)[k]);
      for (int l = 0; l < 3; ++l)
        if (corner[k] == site.corner[l]) {
          here[k] = weight[l];
          ++same;
        }
    }
    if (same < 3) continue;
    site.point = {f, here[1], here[2]};
    std::copy_n(corner, 3, site.corner);
    return;
  }
}
