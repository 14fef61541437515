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

#ifndef LMP_MEMBRANE_MESH_TEXT_H
#define LMP_MEMBRANE_MESH_TEXT_H

#include "membrane_triangle_mesh.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace Membrane_NS {

// What the readers and writers of mesh files share.

// === Messages

/// Throws "Mesh file <path>: <problem>", or "Mesh file <path>, line <line>: ..." if line > 0.
[[noreturn]] void mesh_file_error(const std::string &path, long line, const std::string &problem);

/// A word of the file in quotes, fit for a message: short and printable.
std::string quoted(std::string_view word);

// === Numbers in text, in the C locale whatever the locale of the program

/// The word as a number, which may be infinite or NaN; false if it is none.
bool parse_number(std::string_view word, double &value);
bool parse_number(std::string_view word, long long &value);

/// Appends the value with 17 digits, which give the same double when read.
void append_number(std::string &text, double value);

// === Lines of words

/** Text taken line by line. A line ends with \n, and its words are set apart by blanks, tabs or
    \r. Blank lines are skipped, and so is all that follows the comment character, if not '\0'. A line
    that ends in the continuation character, if not '\0', goes on in the next one. */
class MeshText {
 public:
  MeshText(const std::string &path, std::string_view content, char comment, std::size_t start = 0,
           long lines_before = 0, char continuation = '\0');

  /// Go to the next line that has words; false at the end of the file.
  bool next_line();

  // === The current line

  int size() const { return static_cast<int>(words_.size()); }
  std::string_view operator[](int i) const { return words_[i]; }
  /// Word i as a finite number, or an error.
  double coordinate(int i) const;
  long long integer(int i) const;
  /// Word i as a count of things, at most 2^31 - 1, or an error.
  int count(int i) const;
  /// Words first, first+1, first+2 as a point; an error if there are fewer.
  Eigen::Vector3d point(int first) const;
  /// Takes the first n characters of word 0 away, and the word if it is empty then.
  void drop_from_first_word(std::size_t n);

  // === The place in the file

  long line() const { return line_; }
  /// Offset of the first byte after the current line.
  std::size_t position() const { return position_; }
  [[noreturn]] void fail(const std::string &problem) const;

 private:
  std::string path_;
  std::string_view content_;
  char comment_, continuation_;
  std::size_t position_;
  long line_;
  std::vector<std::string_view> words_;
};

/// Corner v if it is one of so many vertices, numbered from 0; an error otherwise.
int checked_corner(const MeshText &text, long long v, int num_points);
/// An error for a face with fewer than 3 corners.
void check_polygon(const MeshText &text, long long corners);

}    // namespace Membrane_NS

#endif
