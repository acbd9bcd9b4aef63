// SPDX-License-Identifier: Apache-2.0
// Allocation. The loader and the very search for the functions behind these may call them, before
// that search has ended: a small arena serves until then.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include "armature/guard/internal/watch.hpp"

namespace armature::guard {
namespace {

class Arena {
 public:
  void* take(std::size_t size) {
    constexpr std::size_t kUnit = alignof(std::max_align_t);
    const std::size_t rounded = (size + kUnit - 1) / kUnit * kUnit;
    const std::size_t at = used_.fetch_add(rounded, std::memory_order_relaxed);
    return at + rounded <= bytes_.size() ? bytes_.data() + at : nullptr;
  }
  bool owns(const void* memory) const {
    return memory >= bytes_.data() && memory < bytes_.data() + bytes_.size();
  }
  std::size_t size_at_most(const void* memory) const {
    return static_cast<std::size_t>(bytes_.data() + bytes_.size() -
                                    static_cast<const std::byte*>(memory));
  }

 private:
  alignas(std::max_align_t) std::array<std::byte, 16384> bytes_{};
  std::atomic<std::size_t> used_{0};
};

constinit Arena arena;
alignas(8) constinit thread_local bool searching = false;  // aligned: see tests/link

/// Like `next`, but nullptr if this thread is already searching.
template <typename Function>
Function* next_or_null(std::atomic<Function*>& known, const char* name) {
  if (Function* function = known.load(std::memory_order_relaxed)) return function;
  if (searching) return nullptr;
  searching = true;
  Function* const function = next(known, name);
  searching = false;
  return function;
}

constinit std::atomic<void* (*)(std::size_t)> malloc_behind{nullptr};
constinit std::atomic<void* (*)(std::size_t, std::size_t)> calloc_behind{nullptr};
constinit std::atomic<void* (*)(void*, std::size_t)> realloc_behind{nullptr};
constinit std::atomic<void (*)(void*)> free_behind{nullptr};

void* move_out_of_arena(void* memory, std::size_t size) {
  void* const moved = next(malloc_behind, "malloc")(size);
  if (moved != nullptr) std::memcpy(moved, memory, std::min(size, arena.size_at_most(memory)));
  return moved;
}

}  // namespace

ARMATURE_GUARD_FUNCTION(void*, malloc, (std::size_t size)) {
  ARMATURE_GUARD_NOTE(malloc, bytes(size));
  auto* const behind = next_or_null(malloc_behind, "malloc");
  return behind != nullptr ? behind(size) : arena.take(size);
}

ARMATURE_GUARD_FUNCTION(void*, calloc, (std::size_t count, std::size_t size)) {
  ARMATURE_GUARD_NOTE(calloc, bytes(count * size));
  auto* const behind = next_or_null(calloc_behind, "calloc");
  return behind != nullptr ? behind(count, size) : arena.take(count * size);
}

ARMATURE_GUARD_FUNCTION(void*, realloc, (void* memory, std::size_t size)) {
  ARMATURE_GUARD_NOTE(realloc, bytes(size));
  if (arena.owns(memory)) return move_out_of_arena(memory, size);
  auto* const behind = next_or_null(realloc_behind, "realloc");
  return behind != nullptr ? behind(memory, size) : arena.take(size);
}

ARMATURE_GUARD_FUNCTION(void, free, (void* memory)) {
  if (memory == nullptr || arena.owns(memory)) return;
  ARMATURE_GUARD_NOTE(free);
  next(free_behind, "free")(memory);
}

// glibc's reallocarray does not come by here: it calls its own realloc.
ARMATURE_GUARD(void*, reallocarray, (void* memory, std::size_t count, std::size_t size),
               (memory, count, size), bytes(count* size))
ARMATURE_GUARD(int, posix_memalign, (void** memory, std::size_t alignment, std::size_t size),
               (memory, alignment, size), bytes(size))
ARMATURE_GUARD(void*, aligned_alloc, (std::size_t alignment, std::size_t size), (alignment, size),
               bytes(size))
ARMATURE_GUARD(void*, memalign, (std::size_t alignment, std::size_t size), (alignment, size),
               bytes(size))
ARMATURE_GUARD(void*, valloc, (std::size_t size), (size), bytes(size))
ARMATURE_GUARD(void*, pvalloc, (std::size_t size), (size), bytes(size))

ARMATURE_GUARD(void*, mmap, (void* at, std::size_t size, int access, int flags, int fd, off_t from),
               (at, size, access, flags, fd, from), bytes(size))
ARMATURE_GUARD(void*, mmap64,
               (void* at, std::size_t size, int access, int flags, int fd, off64_t from),
               (at, size, access, flags, fd, from), bytes(size))
ARMATURE_GUARD(int, munmap, (void* at, std::size_t size), (at, size), bytes(size))
ARMATURE_GUARD(int, mprotect, (void* at, std::size_t size, int access), (at, size, access),
               bytes(size))
ARMATURE_GUARD(int, madvise, (void* at, std::size_t size, int advice), (at, size, advice),
               bytes(size))
ARMATURE_GUARD(int, mlock, (const void* at, std::size_t size), (at, size), bytes(size))
ARMATURE_GUARD(int, brk, (void* end), (end))
ARMATURE_GUARD(void*, sbrk, (intptr_t by), (by))

}  // namespace armature::guard
