// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/pages.hpp"

#include <algorithm>
#include <cstring>

#include <sys/mman.h>

namespace armature::platform {
namespace {

void* found(void* place) { return place == MAP_FAILED ? nullptr : place; }

void* new_pages(std::size_t size) {
  return found(::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
}

#if defined(__SANITIZE_THREAD__)
/// The thread sanitizer does not see mremap: what another thread has done to pages that lay there
/// before would be a race to it.
void* moved_pages(void* at, std::size_t before, std::size_t after) {
  void* const place = new_pages(after);
  if (place == nullptr) return nullptr;
  std::memcpy(place, at, std::min(before, after));
  ::munmap(at, before);
  return place;
}
#else
void* moved_pages(void* at, std::size_t before, std::size_t after) {
  return found(::mremap(at, before, after, MREMAP_MAYMOVE));
}
#endif

}  // namespace

void* resize_pages(void* at, std::size_t before, std::size_t after) noexcept {
  if (after == 0) {
    if (at != nullptr) ::munmap(at, before);
    return nullptr;
  }
  return at != nullptr ? moved_pages(at, before, after) : new_pages(after);
}

}  // namespace armature::platform
