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

#ifndef LMP_SRD_GRID_H
#define LMP_SRD_GRID_H

#include "domain.h"
#include "pointers.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace LAMMPS_NS {

/** The grid of collision cells: where it is, which cells a rank holds, and sums over the ranks that
    share a cell.

    Cells divide the box; in a tilted box they are tilted alike. Each rank holds the cells that its
    sub-domain, widened by a reach, may touch wherever the grid is placed; so neighbours hold some
    cells in common, and a particle may stray from its owner's sub-domain by as much as the reach,
    though not by more than half of the narrowest sub-domain.

    Cells may be larger than sub-domains. In directions without periodicity the grid has one more
    cell, since the first and the last may stick out of the box. */
class SRDGrid : protected Pointers {
 public:
  /// size: of a cell; the box is divided so as to come closest to it.
  SRDGrid(class LAMMPS *, double size);

  // === Geometry

  /// Collective. Call when the box or sub-domains may have changed; does nothing if they have not.
  void setup(double reach);
  int divisions(int k) const { return n[k]; }
  double edge(int k) const { return edges[k]; }
  double cell_volume() const { return edges[0] * edges[1] * edges[2]; }
  /// Largest relative deviation of an edge from the size asked for.
  double deviation() const;

  // === Cells of this rank, numbered [0, size())

  int size() const { return length[0] * length[1] * length[2]; }
  /// Of all cells: the same number on all ranks.
  const std::vector<int64_t> &numbers() const { return number; }
  int64_t num_numbers() const { return (int64_t) all[0] * all[1] * all[2]; }
  /// Each cell is owned by one of the ranks that hold it.
  bool owned(int cell) const { return owner[cell]; }
  /// Collective: sum width numbers a cell over the ranks that hold it, in the order of ranks, so
  /// that all have the same sums to the last bit.
  void sum(double *values, int width);

  // === Where the grid is

  /// Begin at this fraction of a cell from the corner of the box, each in [0, 1).
  void place(const double *shift);
  /// The cell of a position; -1 if this rank does not hold it.
  int cell(const double *x) const
  {
    double t[3];
    grid_coordinates(x, t);
    return cell_at(t);
  }
  /// The same for many positions, three numbers each.
  void find_cells(const double *x, int count, int *cells) const;
  /// The same, and the position relative to the centre of the cell.
  int cell(const double *x, double *offset) const;
  /// How many times the grid, repeated periodically, has been passed on the way to a position.
  void passed(const double *x, int *times) const
  {
    double t[3];
    grid_coordinates(x, t);
    for (int k = 0; k < 3; ++k)
      times[k] = periodic[k] ? static_cast<int>(std::floor(std::floor(t[k]) / n[k])) : 0;
  }
  static constexpr int BLOCK = 512;
  /// Which of up to BLOCK positions x + ahead v are further from the sub-domain than the reach (or half the box);
  /// returns how many.
  int find_strayed(const double *x, const double *v, double ahead, int count, int *which) const;
  /// Which of up to BLOCK positions are beyond the faces of the box, or may be if that is tilted;
  /// returns how many.
  int find_outside(const double *x, int count, int *which) const;
  /// Back into the box in periodic directions in which this rank has all of it.
  void wrap(double *x, imageint &image) const;
  /// Walls: the position at fractions f in [0, 1) of a cell, which may be outside of the box.
  void position_in_cell(int cell, const double *f, double *x) const;
  /// Whether a cell is partly outside of the box.
  bool sticks_out(int cell) const;

  double memory_usage() const;

 private:
  double wanted;
  int n[3], all[3];                  // divisions of the box; cells
  bool periodic[3], spans_box[3];    // the latter: this rank's sub-domain does
  double edges[3];
  int start[3], length[3];    // of this rank's cells
  double corner[3], inverse[6], cell_vectors[6], shift[3];
  double stray_lo[3], stray_hi[3];

  std::vector<double> seen;    // box and sub-domain of the last setup()
  std::vector<int64_t> number;
  std::vector<char> owner;

  struct Partner {
    int rank;
    std::vector<int> cells;    // in common, by increasing number
    std::vector<double> send, receive;
  };
  std::vector<Partner> partners;
  std::vector<int> shared;    // cells held by several ranks
  std::vector<double> own;
  std::vector<MPI_Request> requests;
  std::vector<MPI_Status> statuses;

  void divide();
  void hold(double reach);
  void find_partners();

  /// In cells from the corner of the grid.
  void grid_coordinates(const double *x, double *t) const
  {
    const double d[3] = {x[0] - corner[0], x[1] - corner[1], x[2] - corner[2]};
    t[0] = inverse[0] * d[0] + inverse[5] * d[1] + inverse[4] * d[2] - shift[0];
    t[1] = inverse[1] * d[1] + inverse[3] * d[2] - shift[1];
    t[2] = inverse[2] * d[2] - shift[2];
  }
  int cell_at(const double *t) const
  {
    int c[3];
    for (int k = 0; k < 3; ++k) {
      c[k] = static_cast<int>(std::floor(t[k])) - start[k];
      if (periodic[k]) {
        while (c[k] < 0) c[k] += n[k];
        while (c[k] >= n[k]) c[k] -= n[k];
      }
      if (c[k] < 0 || c[k] >= length[k]) return -1;
    }
    return (c[2] * length[1] + c[1]) * length[0] + c[0];
  }
};

}    // namespace LAMMPS_NS

#endif
