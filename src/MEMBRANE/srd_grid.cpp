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

#include "srd_grid.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "mesh_box.h"

#include <algorithm>

using namespace LAMMPS_NS;

// in cells
static constexpr double ROOM = 0.25;

/* ---------------------------------------------------------------------- */

SRDGrid::SRDGrid(LAMMPS *lmp, double size) :
    Pointers(lmp),
    wanted(size), n{1, 1, 1}, all{1, 1, 1}, periodic{true, true, true}, spans_box{true, true, true},
    edges{size, size, size}, start{0, 0, 0}, length{0, 0, 0}, corner{0.0, 0.0, 0.0}, inverse{},
    cell_vectors{}, shift{0.0, 0.0, 0.0}, stray_lo{}, stray_hi{}
{
}

/* ----------------------------------------------------------------------
   the box is the same on all ranks, but load balancing may move the sub-domains of a few only
------------------------------------------------------------------------- */

void SRDGrid::setup(double reach)
{
  std::vector<double> now(domain->h, domain->h + 6);
  now.insert(now.end(), domain->boxlo, domain->boxlo + 3);
  const double *lo = domain->triclinic ? domain->sublo_lamda : domain->sublo;
  const double *hi = domain->triclinic ? domain->subhi_lamda : domain->subhi;
  now.insert(now.end(), lo, lo + 3);
  now.insert(now.end(), hi, hi + 3);
  now.push_back(reach);
  int changed = now != seen, any;
  MPI_Allreduce(&changed, &any, 1, MPI_INT, MPI_MAX, world);
  if (!any) return;
  seen = now;

  divide();
  hold(reach);
  find_partners();
}

void SRDGrid::divide()
{
  const double *h = domain->h, *h_inv = domain->h_inv;
  for (int k = 0; k < 3; ++k) {
    periodic[k] = domain->periodicity[k];
    corner[k] = domain->boxlo[k];
    n[k] = std::max(1, static_cast<int>(std::lround(h[k] / wanted)));
    edges[k] = h[k] / n[k];
    all[k] = periodic[k] ? n[k] : n[k] + 1;
  }
  if ((double) all[0] * all[1] * all[2] > MAXSMALLINT)
    error->all(FLERR, "The box has too many SRD cells of size {}: use larger ones", wanted);

  // rows of h_inv are x, y, z of a position in cells; columns of h are the box vectors

  const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  for (int i = 0; i < 6; ++i) {
    inverse[i] = h_inv[i] * n[row[i]];
    cell_vectors[i] = h[i] / n[column[i]];
  }
}

double SRDGrid::deviation() const
{
  double most = 0.0;
  for (double a : edges) most = std::max(most, std::fabs(a / wanted - 1.0));
  return most;
}

/* ----------------------------------------------------------------------
   the cells of this rank, for any place of the grid
------------------------------------------------------------------------- */

void SRDGrid::hold(double reach)
{
  const double *h_inv = domain->h_inv;
  const double per_length[3] = {
      std::sqrt(h_inv[0] * h_inv[0] + h_inv[5] * h_inv[5] + h_inv[4] * h_inv[4]),
      std::sqrt(h_inv[1] * h_inv[1] + h_inv[3] * h_inv[3]), std::fabs(h_inv[2])};
  double lo[3], hi[3], width[3], narrowest[3];    // fractions of the box
  for (int k = 0; k < 3; ++k) {
    if (domain->triclinic) {
      lo[k] = domain->sublo_lamda[k];
      hi[k] = domain->subhi_lamda[k];
    } else {
      lo[k] = (domain->sublo[k] - domain->boxlo[k]) / domain->prd[k];
      hi[k] = (domain->subhi[k] - domain->boxlo[k]) / domain->prd[k];
    }
    width[k] = hi[k] - lo[k];
  }

  // LAMMPS' exchange hands an atom on to the next rank, not to one beyond: neighbours may be narrow

  MPI_Allreduce(width, narrowest, 3, MPI_DOUBLE, MPI_MIN, world);
  for (int k = 0; k < 3; ++k) {
    spans_box[k] = width[k] > 0.999999;
    const double more = spans_box[k] ? 0.5 : std::min(reach * per_length[k], 0.5 * narrowest[k]);
    stray_lo[k] = lo[k] - more;
    stray_hi[k] = hi[k] + more;

    // one cell lower for the shift, and to either side some room for what a collision just before
    // does to where a particle was foreseen

    int first = static_cast<int>(std::floor(stray_lo[k] * n[k] - ROOM)) - 1,
        last = static_cast<int>(std::floor(stray_hi[k] * n[k] + ROOM));
    if (!periodic[k]) {
      first = std::max(first, -1);
      last = std::min(last, n[k] - 1);
    } else if (last - first + 1 >= n[k]) {
      first = 0;
      last = n[k] - 1;
    }
    start[k] = first;
    length[k] = last - first + 1;
  }

  number.resize(size());
  for (int c = 0; c < size(); ++c) {
    const int local[3] = {c % length[0], c / length[0] % length[1], c / (length[0] * length[1])};
    int64_t g[3];
    for (int k = 0; k < 3; ++k) {
      g[k] = start[k] + local[k];
      g[k] = periodic[k] ? (g[k] % n[k] + n[k]) % n[k] : g[k] + 1;
    }
    number[c] = (g[2] * all[1] + g[1]) * all[0] + g[0];
  }
}

/* ----------------------------------------------------------------------
   each rank tells all others its range; both sides of a pair list the same cells in the same order
------------------------------------------------------------------------- */

void SRDGrid::find_partners()
{
  partners.clear();
  shared.clear();
  owner.assign(size(), 1);
  if (comm->nprocs == 1) return;

  int mine[6] = {start[0], start[1], start[2], length[0], length[1], length[2]};
  std::vector<int> ranges(6 * (size_t) comm->nprocs);
  MPI_Allgather(mine, 6, MPI_INT, ranges.data(), 6, MPI_INT, world);

  std::vector<char> in_common(size(), 0);
  for (int p = 0; p < comm->nprocs; ++p) {
    if (p == comm->me) continue;
    const int *theirs = &ranges[6 * (size_t) p];

    // along each direction, my cells that are also theirs

    std::vector<int> both[3];
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < length[k]; ++i) {
        int other = start[k] + i - theirs[k];
        if (periodic[k]) other = (other % n[k] + n[k]) % n[k];
        if (other >= 0 && other < theirs[3 + k]) both[k].push_back(i);
      }
    Partner partner;
    partner.rank = p;
    for (int iz : both[2])
      for (int iy : both[1])
        for (int ix : both[0]) partner.cells.push_back((iz * length[1] + iy) * length[0] + ix);
    if (partner.cells.empty()) continue;
    std::sort(partner.cells.begin(), partner.cells.end(), [this](int a, int b) {
      return number[a] < number[b];
    });
    for (int c : partner.cells) {
      if (p < comm->me) owner[c] = 0;
      if (!in_common[c]) shared.push_back(c);
      in_common[c] = 1;
    }
    partners.push_back(std::move(partner));
  }
  requests.resize(2 * partners.size());
  statuses.resize(2 * partners.size());
}

/* ---------------------------------------------------------------------- */

void SRDGrid::sum(double *values, int width)
{
  if (partners.empty()) return;
  int nrequests = 0;
  for (Partner &p : partners) {
    p.receive.resize(width * p.cells.size());
    MPI_Irecv(p.receive.data(), width * p.cells.size(), MPI_DOUBLE, p.rank, 0, world,
              &requests[nrequests++]);
  }
  for (Partner &p : partners) {
    p.send.resize(width * p.cells.size());
    double *to = p.send.data();
    for (int c : p.cells) to = std::copy_n(values + (size_t) width * c, width, to);
    MPI_Isend(p.send.data(), width * p.cells.size(), MPI_DOUBLE, p.rank, 0, world,
              &requests[nrequests++]);
  }
  own.resize(width * shared.size());
  double *to = own.data();
  for (int c : shared) {
    double *from = values + (size_t) width * c;
    to = std::copy_n(from, width, to);
    std::fill_n(from, width, 0.0);
  }
  MPI_Waitall(nrequests, requests.data(), statuses.data());

  bool added = false;
  auto add = [&](const std::vector<int> &cells, const std::vector<double> &terms) {
    const double *from = terms.data();
    for (int c : cells)
      for (int j = 0; j < width; ++j) values[(size_t) width * c + j] += *from++;
  };
  for (Partner &p : partners) {
    if (!added && p.rank > comm->me) {
      add(shared, own);
      added = true;
    }
    add(p.cells, p.receive);
  }
  if (!added) add(shared, own);
}

/* ---------------------------------------------------------------------- */

void SRDGrid::place(const double *fractions)
{
  std::copy_n(fractions, 3, shift);
}

/* ----------------------------------------------------------------------
   in vectors, for positions at most once through the boundary; the others are looked at one by one
------------------------------------------------------------------------- */

void SRDGrid::find_cells(const double *x, int count, int *cells) const
{
  constexpr int ELSEWHERE = -2;
  const double corner0 = corner[0], corner1 = corner[1], corner2 = corner[2];
  const double m0 = inverse[0], m1 = inverse[1], m2 = inverse[2], m3 = inverse[3], m4 = inverse[4],
               m5 = inverse[5];
  const double shift0 = shift[0], shift1 = shift[1], shift2 = shift[2];
  int turn[3];    // what passing through the boundary adds
  for (int k = 0; k < 3; ++k) turn[k] = periodic[k] ? n[k] : 0;
  const int start0 = start[0], start1 = start[1], start2 = start[2];
  const int n0 = n[0], n1 = n[1], n2 = n[2], turn0 = turn[0], turn1 = turn[1], turn2 = turn[2];
  const int length0 = length[0], length1 = length[1], length2 = length[2];
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const double d0 = x[3 * i] - corner0, d1 = x[3 * i + 1] - corner1, d2 = x[3 * i + 2] - corner2;
    int c0 = static_cast<int>(std::floor(m0 * d0 + m5 * d1 + m4 * d2 - shift0)) - start0;
    int c1 = static_cast<int>(std::floor(m1 * d1 + m3 * d2 - shift1)) - start1;
    int c2 = static_cast<int>(std::floor(m2 * d2 - shift2)) - start2;
    c0 += (c0 < 0 ? turn0 : 0) - (c0 >= n0 ? turn0 : 0);
    c1 += (c1 < 0 ? turn1 : 0) - (c1 >= n1 ? turn1 : 0);
    c2 += (c2 < 0 ? turn2 : 0) - (c2 >= n2 ? turn2 : 0);
    const bool here =
        (c0 >= 0) & (c0 < length0) & (c1 >= 0) & (c1 < length1) & (c2 >= 0) & (c2 < length2);
    cells[i] = here ? (c2 * length1 + c1) * length0 + c0 : ELSEWHERE;
  }
  for (int i = 0; i < count; ++i)
    if (cells[i] == ELSEWHERE) cells[i] = cell(x + 3 * (size_t) i);
}

int SRDGrid::cell(const double *x, double *offset) const
{
  double t[3], f[3];
  grid_coordinates(x, t);
  for (int k = 0; k < 3; ++k) f[k] = t[k] - std::floor(t[k]) - 0.5;
  const double *a = cell_vectors;
  offset[0] = a[0] * f[0] + a[5] * f[1] + a[4] * f[2];
  offset[1] = a[1] * f[1] + a[3] * f[2];
  offset[2] = a[2] * f[2];
  return cell_at(t);
}

int SRDGrid::find_strayed(const double *x, const double *v, double ahead, int count, int *which) const
{
  const double corner0 = corner[0], corner1 = corner[1], corner2 = corner[2];
  const double m0 = inverse[0], m1 = inverse[1], m2 = inverse[2], m3 = inverse[3], m4 = inverse[4],
               m5 = inverse[5];
  const double lo0 = stray_lo[0] * n[0], lo1 = stray_lo[1] * n[1], lo2 = stray_lo[2] * n[2];
  const double hi0 = stray_hi[0] * n[0], hi1 = stray_hi[1] * n[1], hi2 = stray_hi[2] * n[2];
  int strayed[BLOCK], found = 0;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const double d0 = x[3 * i] + ahead * v[3 * i] - corner0, d1 = x[3 * i + 1] + ahead * v[3 * i + 1] - corner1,
                 d2 = x[3 * i + 2] + ahead * v[3 * i + 2] - corner2;
    const double s0 = m0 * d0 + m5 * d1 + m4 * d2, s1 = m1 * d1 + m3 * d2, s2 = m2 * d2;
    strayed[i] = !((s0 >= lo0) & (s0 <= hi0) & (s1 >= lo1) & (s1 <= hi1) & (s2 >= lo2) & (s2 <= hi2));
  }
  for (int i = 0; i < count; ++i) {
    which[found] = i;
    found += strayed[i];
  }
  return found;
}

int SRDGrid::find_outside(const double *x, int count, int *which) const
{
  const double *lo = domain->boxlo, *hi = domain->boxhi;
  const double lo0 = lo[0], lo1 = lo[1], lo2 = lo[2], hi0 = hi[0], hi1 = hi[1], hi2 = hi[2];
  const int tilted = domain->triclinic;
  int outside[BLOCK], n = 0;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i)
    outside[i] = tilted |
        !((x[3 * i] >= lo0) & (x[3 * i] < hi0) & (x[3 * i + 1] >= lo1) & (x[3 * i + 1] < hi1) &
          (x[3 * i + 2] >= lo2) & (x[3 * i + 2] < hi2));
  for (int i = 0; i < count; ++i) {
    which[n] = i;
    n += outside[i];
  }
  return n;
}

void SRDGrid::wrap(double *x, imageint &image) const
{
  double t[3];
  grid_coordinates(x, t);
  const Eigen::Matrix3d box = box_vectors(*domain);
  int boxes[3] = {0, 0, 0};
  for (int k = 0; k < 3; ++k) {
    const double s = t[k] + shift[k];
    if (!spans_box[k] || !periodic[k] || (s >= 0.0 && s < n[k])) continue;
    boxes[k] = static_cast<int>(std::floor(s / n[k]));
    for (int j = 0; j < 3; ++j) x[j] -= boxes[k] * box(j, k);
  }
  if (!(boxes[0] || boxes[1] || boxes[2])) return;
  const int ix = static_cast<int>(image & IMGMASK) + boxes[0],
            iy = static_cast<int>(image >> IMGBITS & IMGMASK) + boxes[1],
            iz = static_cast<int>(image >> IMG2BITS) + boxes[2];
  image = (static_cast<imageint>(ix) & IMGMASK) | (static_cast<imageint>(iy) & IMGMASK) << IMGBITS |
      (static_cast<imageint>(iz) & IMGMASK) << IMG2BITS;
}

/* ---------------------------------------------------------------------- */

bool SRDGrid::sticks_out(int c) const
{
  const int local[3] = {c % length[0], c / length[0] % length[1], c / (length[0] * length[1])};
  for (int k = 0; k < 3; ++k) {
    const int g = start[k] + local[k];
    if (!periodic[k] && shift[k] > 0.0 && (g == -1 || g == n[k] - 1)) return true;
  }
  return false;
}

void SRDGrid::position_in_cell(int c, const double *f, double *x) const
{
  const int local[3] = {c % length[0], c / length[0] % length[1], c / (length[0] * length[1])};
  double t[3];
  for (int k = 0; k < 3; ++k) t[k] = start[k] + local[k] + f[k] + shift[k];
  const double *a = cell_vectors;
  x[0] = corner[0] + a[0] * t[0] + a[5] * t[1] + a[4] * t[2];
  x[1] = corner[1] + a[1] * t[1] + a[3] * t[2];
  x[2] = corner[2] + a[2] * t[2];
}

double SRDGrid::memory_usage() const
{
  double bytes = number.capacity() * sizeof(int64_t) + owner.capacity();
  for (const Partner &p : partners)
    bytes += p.cells.capacity() * sizeof(int) +
        (p.send.capacity() + p.receive.capacity()) * sizeof(double);
  return bytes + own.capacity() * sizeof(double);
}
