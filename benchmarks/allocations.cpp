// SPDX-License-Identifier: Apache-2.0
// Stands in front of the C library's allocation functions; `operator new` comes here, too.
#include "benchmarks/allocations.hpp"

#include <atomic>
#include <cerrno>
#include <cstddef>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* at, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

std::atomic<std::uint64_t> count{0};

void count_one() { count.fetch_add(1, std::memory_order_relaxed); }

}  // namespace

extern "C" {

void* malloc(std::size_t size) noexcept {
  count_one();
  return __libc_malloc(size);
}

void* calloc(std::size_t elements, std::size_t size) noexcept {
  count_one();
  return __libc_calloc(elements, size);
}

void* realloc(void* at, std::size_t size) noexcept {
  count_one();
  return __libc_realloc(at, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  count_one();
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  count_one();
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** at, std::size_t alignment, std::size_t size) noexcept {
  count_one();
  void* const memory = __libc_memalign(alignment, size);
  if (memory == nullptr) return ENOMEM;
  *at = memory;
  return 0;
}
}

std::uint64_t armature::benchmarks::allocations() { return count.load(std::memory_order_relaxed); }
