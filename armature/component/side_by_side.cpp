// SPDX-License-Identifier: Apache-2.0
#include "armature/component/internal/side_by_side.hpp"

#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <new>

namespace armature::component::internal {
namespace {

constexpr std::size_t kLine = 64;
constexpr std::size_t kSlab = 64 * 1024;  // size and alignment
constexpr std::size_t kLargest = kSlab / 8;

std::size_t whole_lines(std::size_t size) { return (size + kLine - 1) / kLine * kLine; }

/// Memory is taken from its front; it goes back when all that was taken was given back.
struct alignas(kLine) Slab {
  std::size_t used = kLine;
  std::size_t living = 0;

  static Slab& of(void* at) {
    return *reinterpret_cast<Slab*>(reinterpret_cast<std::uintptr_t>(at) & ~(kSlab - 1));
  }
};

std::mutex mutex;
Slab* current = nullptr;

Slab* new_slab() {
  void* const memory = std::aligned_alloc(kSlab, kSlab);
  return memory == nullptr ? nullptr : new (memory) Slab;
}

}  // namespace

void* allocate_side_by_side(std::size_t size) {
  if (size > kLargest) return ::operator new(size);
  const std::lock_guard lock(mutex);
  if (current == nullptr || current->used + whole_lines(size) > kSlab) current = new_slab();
  if (current == nullptr) throw std::bad_alloc();
  void* const at = reinterpret_cast<std::byte*>(current) + current->used;
  current->used += whole_lines(size);
  ++current->living;
  return at;
}

void free_side_by_side(void* at, std::size_t size) {
  if (size > kLargest) return ::operator delete(at);
  const std::lock_guard lock(mutex);
  Slab& slab = Slab::of(at);
  if (--slab.living > 0) return;
  if (&slab == current) current = nullptr;
  std::free(&slab);
}

}  // namespace armature::component::internal
