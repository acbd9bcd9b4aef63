// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/body.hpp"

#include <cstdlib>
#include <new>

#include "armature/platform/pages.hpp"
#include "armature/ride/memory_share.hpp"

namespace armature::ride {
namespace {

constexpr std::size_t kKiB = 1024;
/// From here on it has pages of its own, which the system has again when they are let go of, and
/// which move without a copy.
constexpr std::size_t kLarge = 128 * kKiB;
constexpr std::size_t kPages = 64 * kKiB;  ///< whole pages on every machine

/// Small ones double; large ones grow by a quarter, since others want memory too.
std::size_t capacity_for(std::size_t least, std::size_t present) {
  constexpr std::size_t kLeast = 64;
  constexpr std::size_t kVeryLarge = 1024 * kKiB;
  const std::size_t more = present < kVeryLarge ? 2 * present : present + present / 4;
  const std::size_t capacity = std::max({least, more, kLeast});
  return capacity < kLarge ? capacity : (capacity + kPages - 1) / kPages * kPages;
}

/// `size` bytes of what is at `from` are kept; nothing if there is no memory for it.
std::byte* moved(std::byte* from, std::size_t before, std::size_t after, std::size_t size) {
  const bool was_large = before >= kLarge;
  const bool is_large = after >= kLarge;
  if (was_large && is_large) {
    return static_cast<std::byte*>(platform::resize_pages(from, before, after));
  }
  if (!was_large && !is_large) return static_cast<std::byte*>(std::realloc(from, after));
  auto* const to = static_cast<std::byte*>(is_large ? platform::resize_pages(nullptr, 0, after)
                                                    : std::malloc(after));
  if (to == nullptr) return nullptr;
  if (size != 0) std::memcpy(to, from, size);
  if (was_large) {
    platform::resize_pages(from, before, 0);
  } else {
    std::free(from);
  }
  return to;
}

}  // namespace

void Body::grow(std::size_t least) {
  const std::size_t capacity = capacity_for(least, capacity_);
  if (share_ != nullptr && !share_->take(capacity - capacity_)) throw std::bad_alloc();
  std::byte* const memory = moved(memory_, capacity_, capacity, size_);
  if (memory == nullptr) {
    if (share_ != nullptr) share_->give(capacity - capacity_);
    throw std::bad_alloc();
  }
  memory_ = memory;
  capacity_ = capacity;
}

void Body::give_back(std::size_t most) {
  if (empty()) return release();
  const std::size_t capacity = capacity_for(std::max(size_, most), 0);
  if (capacity >= capacity_) return;
  const std::size_t kept = std::max(capacity, std::min(capacity_, kLarge));  // where it is
  if (kept < capacity_) give_pages(memory_ + kept, capacity_ - kept);
  capacity_ = kept;
  if (capacity == kept) return;
  std::byte* const memory = moved(memory_, capacity_, capacity, size_);
  if (memory == nullptr) return;
  if (share_ != nullptr) share_->give(capacity_ - capacity);
  memory_ = memory;
  capacity_ = capacity;
}

void Body::release() {
  if (capacity_ >= kLarge) {
    give_pages(memory_, capacity_);
  } else {
    std::free(memory_);
    if (share_ != nullptr) share_->give(capacity_);
  }
  memory_ = nullptr;
  size_ = capacity_ = 0;
}

void Body::give_pages(std::byte* pages, std::size_t bytes) {
  if (share_ != nullptr) {
    share_->give_pages(pages, bytes);
  } else {
    platform::resize_pages(pages, bytes, 0);
  }
}

}  // namespace armature::ride
