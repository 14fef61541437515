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

#include "membrane_mesh_text.h"

#include <charconv>
#include <climits>
#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace Membrane_NS;

/* ---------------------------------------------------------------------- */

void Membrane_NS::mesh_file_error(const std::string &path, long line, const std::string &problem)
{
  const std::string where = line > 0 ? ", line " + std::to_string(line) : "";
  throw MeshError("Mesh file " + path + where + ": " + problem);
}

std::string Membrane_NS::quoted(std::string_view word)
{
  constexpr size_t longest = 24;
  std::string text = "'";
  for (char c : word.substr(0, longest)) text += (c >= ' ' && c <= '~') ? c : '?';
  return text + (word.size() > longest ? "...'" : "'");
}

/* ----------------------------------------------------------------------
   std::from_chars, unlike strtod, does not depend on the locale; but it knows no leading +, and
   older C++17 libraries have it for integers only
------------------------------------------------------------------------- */

namespace {

template <typename T> bool from_chars_whole(std::string_view word, T &value)
{
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  return result.ec == std::errc() && result.ptr == word.data() + word.size();
}

}    // namespace

bool Membrane_NS::parse_number(std::string_view word, double &value)
{
#if defined(__cpp_lib_to_chars)
  return from_chars_whole(word, value);
#else
  const std::string copy(word);
  char *end = nullptr;
  value = std::strtod(copy.c_str(), &end);
  return !copy.empty() && end == copy.c_str() + copy.size();
#endif
}

bool Membrane_NS::parse_number(std::string_view word, long long &value)
{
  return from_chars_whole(word, value);
}

void Membrane_NS::append_number(std::string &text, double value)
{
  char buffer[32];
#if defined(__cpp_lib_to_chars)
  const auto end =
      std::to_chars(buffer, buffer + sizeof(buffer), value, std::chars_format::general, 17).ptr;
#else
  const auto end = buffer + std::snprintf(buffer, sizeof(buffer), "%.17g", value);
#endif
  text.append(buffer, end);
}

/* ---------------------------------------------------------------------- */

MeshText::MeshText(const std::string &path, std::string_view content, char comment,
                   std::size_t start, long lines_before, char continuation) :
    path_(path),
    content_(content), comment_(comment), continuation_(continuation), position_(start),
    line_(lines_before)
{
}

bool MeshText::next_line()
{
  words_.clear();
  bool continued = false;
  while (position_ < content_.size() && (words_.empty() || continued)) {
    ++line_;
    const size_t newline = content_.find('\n', position_);
    std::string_view rest = content_.substr(position_, newline - position_);
    position_ = newline == std::string_view::npos ? content_.size() : newline + 1;
    if (comment_) rest = rest.substr(0, rest.find(comment_));
    constexpr std::string_view blanks = " \t\r\v\f";
    rest = rest.substr(0, rest.find_last_not_of(blanks) + 1);    // npos + 1 = 0
    continued = continuation_ && !rest.empty() && rest.back() == continuation_;
    if (continued) rest.remove_suffix(1);
    while (true) {
      const size_t first = rest.find_first_not_of(blanks);
      if (first == std::string_view::npos) break;
      rest.remove_prefix(first);
      const std::string_view word = rest.substr(0, rest.find_first_of(blanks));
      words_.push_back(word);
      rest.remove_prefix(word.size());
    }
  }
  return !words_.empty();
}

/* ---------------------------------------------------------------------- */

double MeshText::coordinate(int i) const
{
  double value;
  if (!parse_number(words_[i], value))
    fail(quoted(words_[i]) + " is not a number; correct it or export the mesh again");
  if (!std::isfinite(value))
    fail("coordinate " + quoted(words_[i]) + " is not finite; correct it or export the mesh again");
  return value;
}

long long MeshText::integer(int i) const
{
  long long value;
  if (!parse_number(words_[i], value))
    fail(quoted(words_[i]) + " is not an integer; correct it or export the mesh again");
  return value;
}

int MeshText::count(int i) const
{
  const long long value = integer(i);
  if (value < 0 || value > INT_MAX)
    fail("the count " + quoted(words_[i]) + " must be between 0 and 2147483647; correct it");
  return static_cast<int>(value);
}

Eigen::Vector3d MeshText::point(int first) const
{
  if (size() < first + 3)
    fail("a vertex needs 3 coordinates, there are " + std::to_string(size() - first) +
         "; correct the line or export the mesh again");
  return {coordinate(first), coordinate(first + 1), coordinate(first + 2)};
}

void MeshText::drop_from_first_word(std::size_t n)
{
  words_[0].remove_prefix(n);
  if (words_[0].empty()) words_.erase(words_.begin());
}

void MeshText::fail(const std::string &problem) const
{
  mesh_file_error(path_, line_, problem);
}

/* ---------------------------------------------------------------------- */

int Membrane_NS::checked_corner(const MeshText &text, long long v, int num_points)
{
  if (v < 0 || v >= num_points)
    text.fail("corner " + std::to_string(v) + " is not one of the " + std::to_string(num_points) +
              " vertices, numbered from 0; correct the face");
  return static_cast<int>(v);
}

void Membrane_NS::check_polygon(const MeshText &text, long long corners)
{
  if (corners < 3)
    text.fail("a face with " + std::to_string(corners) +
              " corners; a face has 3 or more: correct it or export the mesh again");
}
