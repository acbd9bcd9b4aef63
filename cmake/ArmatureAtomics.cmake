# SPDX-License-Identifier: Apache-2.0
# Counters of 64 bits between threads are a few instructions, or on a processor that has none for them (ARMv5) calls of
# libatomic, which GCC brings. There they take a lock of libatomic's for some instructions.
include(CheckCXXSourceCompiles)
check_cxx_source_compiles(
  "#include <atomic>
#include <cstdint>
std::atomic<std::uint64_t> counter{0};
int main() { return counter.fetch_add(1) == 0 ? 0 : 1; }"
  ARMATURE_HAS_ATOMICS_OF_64_BITS)
set(ARMATURE_ATOMICS)
if(NOT ARMATURE_HAS_ATOMICS_OF_64_BITS)
  set(ARMATURE_ATOMICS -l:libatomic.a)  # its archive: a small board may have no libatomic.so.1
endif()
