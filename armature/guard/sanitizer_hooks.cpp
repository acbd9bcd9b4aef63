// SPDX-License-Identifier: Apache-2.0
// AddressSanitizer and ThreadSanitizer stand in front of the C library themselves, before the
// guard; they tell of allocation. Other calls are watched in the other builds.
#include "armature/guard/internal/watch.hpp"

// As in sanitizer/allocator_interface.h, which not every compiler brings along.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*malloc_hook)(const volatile void*,
                                                                             std::size_t),
                                                         void (*free_hook)(const volatile void*));

namespace armature::guard {
namespace {

void allocated(const volatile void*, std::size_t size) {
  if (watched()) note_violation("malloc", bytes(size), __builtin_return_address(0));
}

void freed(const volatile void* memory) {
  if (memory != nullptr && watched()) note_violation("free", {}, __builtin_return_address(0));
}

[[gnu::constructor]] void begin() { __sanitizer_install_malloc_and_free_hooks(&allocated, &freed); }

}  // namespace
}  // namespace armature::guard
