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

#ifndef MEMBRANE_TEST_COUNT_ALLOCATIONS_H
#define MEMBRANE_TEST_COUNT_ALLOCATIONS_H

// How often memory is asked for, and how much at once, by malloc() or new, where the C library or
// the sanitizer lets one count. Include in one file of a program only: it replaces malloc().

#include <cstddef>
#include <cstdlib>

namespace Membrane_TEST {

inline long allocations = 0;
inline std::size_t largest_piece = 0;    // bytes

inline void count_allocation(std::size_t size)
{
  ++allocations;
  if (size > largest_piece) largest_piece = size;
}

#if defined(__SANITIZE_ADDRESS__)

extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*)(const volatile void *, size_t),
                                                         void (*)(const volatile void *));

inline const bool counts_allocations = [] {
  return __sanitizer_install_malloc_and_free_hooks(
             [](const volatile void *, size_t size) {
               count_allocation(size);
             },
             [](const volatile void *) {
             }) > 0;
}();

#elif defined(__GLIBC__)

inline const bool counts_allocations = true;

#else

inline const bool counts_allocations = false;

#endif

}    // namespace Membrane_TEST

#if !defined(__SANITIZE_ADDRESS__) && defined(__GLIBC__)

extern "C" void *__libc_malloc(size_t) noexcept;

extern "C" void *malloc(size_t size) noexcept
{
  Membrane_TEST::count_allocation(size);
  return __libc_malloc(size);
}

#endif

#endif
