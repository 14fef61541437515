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

#ifndef LMP_RESTART_ARCHIVE_H
#define LMP_RESTART_ARCHIVE_H

#include "lmptype.h"

#include <cstdio>
#include <cstring>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

namespace LAMMPS_NS {

/** What a style keeps in a restart file, as bytes. One function says what that is, for writing and for
    reading alike:

      void archive(RestartArchive &file) { file(modulus); file(references); }

    A reader that finds fewer bytes than it asks for gets zeros, and ok() is false from then on. */
class RestartArchive {
 public:
  /// For writing; the result is bytes().
  RestartArchive() : reading(false) {}
  /// For reading these bytes.
  explicit RestartArchive(std::string data) : reading(true), data(std::move(data)) {}

  bool is_reading() const { return reading; }
  const std::string &bytes() const { return data; }
  bool ok() const { return good; }
  bool at_end() const { return position == data.size(); }

  /// As Fix::write_restart() has it to be: the size of what follows, and that.
  void write_of_fix(FILE *fp) const
  {
    const int length = static_cast<int>(data.size()), size = length + sizeof(int);
    fwrite(&size, sizeof(int), 1, fp);
    fwrite(&length, sizeof(int), 1, fp);
    fwrite(data.data(), 1, length, fp);
  }
  /// What Fix::restart() is given: without the size, hence the length once more.
  static RestartArchive of_fix(const char *buf)
  {
    int length;
    std::memcpy(&length, buf, sizeof(int));
    return RestartArchive(std::string(buf + sizeof(int), length));
  }

  template <class T, std::enable_if_t<std::is_arithmetic_v<T>, int> = 0> void operator()(T &value)
  {
    if (!reading) {
      data.append(reinterpret_cast<const char *>(&value), sizeof(T));
      return;
    }
    value = T();
    good = good && position + sizeof(T) <= data.size();
    if (!good) return;
    std::memcpy(&value, data.data() + position, sizeof(T));
    position += sizeof(T);
  }

  /// A struct that says itself what is stored of it
  template <class T, std::enable_if_t<std::is_class_v<T>, int> = 0> void operator()(T &value)
  {
    value.archive(*this);
  }
  void operator()(std::string &value)
  {
    for (size_t i = 0, n = size_of(value); i < n; ++i) (*this)(value[i]);
  }
  template <class T> void operator()(std::vector<T> &value)
  {
    for (size_t i = 0, n = size_of(value); i < n; ++i) (*this)(value[i]);
  }
  template <class K, class T> void operator()(std::map<K, T> &value)
  {
    bigint n = value.size();
    (*this)(n);
    if (!reading)
      for (auto &[key, entry] : value) {
        K copy = key;
        (*this)(copy);
        (*this)(entry);
      }
    if (reading) value.clear();
    for (bigint i = 0; reading && good && i < n; ++i) {
      K key;
      (*this)(key);
      (*this)(value[key]);
    }
  }

 private:
  bool reading, good = true;
  std::string data;
  size_t position = 0;

  template <class Sequence> size_t size_of(Sequence &value)
  {
    bigint n = value.size();
    (*this)(n);
    if (reading) {
      good = good && n >= 0 && static_cast<size_t>(n) <= data.size() - position;
      value.resize(good ? n : 0);
    }
    return value.size();
  }
};

}    // namespace LAMMPS_NS

#endif
