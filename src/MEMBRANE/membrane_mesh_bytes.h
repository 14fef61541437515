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

#ifndef LMP_MEMBRANE_MESH_BYTES_H
#define LMP_MEMBRANE_MESH_BYTES_H

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

namespace Membrane_NS {

// Numbers in binary files, byte by byte: the byte order of the machine does not matter.

template <typename T>
using UnsignedLike =
    std::conditional_t<sizeof(T) == 1, uint8_t,
                       std::conditional_t<sizeof(T) == 2, uint16_t,
                                          std::conditional_t<sizeof(T) == 4, uint32_t, uint64_t>>>;

/// The number stored in the sizeof(T) bytes at data.
template <typename T> T load(const char *data, bool big_endian)
{
  UnsignedLike<T> bits = 0;
  for (size_t i = 0; i < sizeof(T); ++i) {
    const size_t shift = 8 * (big_endian ? sizeof(T) - 1 - i : i);
    bits |= static_cast<UnsignedLike<T>>(
        static_cast<UnsignedLike<T>>(static_cast<unsigned char>(data[i])) << shift);
  }
  T value;
  std::memcpy(&value, &bits, sizeof(T));
  return value;
}

/// Appends the sizeof(T) bytes of the number, the low ones first.
template <typename T> void append_little_endian(std::string &bytes, T value)
{
  UnsignedLike<T> bits;
  std::memcpy(&bits, &value, sizeof(T));
  for (size_t i = 0; i < sizeof(T); ++i) bytes += static_cast<char>(bits >> 8 * i & 0xff);
}

}    // namespace Membrane_NS

#endif
