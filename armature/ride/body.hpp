// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <utility>

namespace armature::ride {

class MemoryShare;

/// Bytes that are written at the end, and kept to be used again: memory is asked for only when it
/// has to hold more than ever before. Where there is none it throws std::bad_alloc and is as it
/// was.
/// @thread one at a time
class Body {
 public:
  Body() = default;
  /// @param share  of which it takes its memory; outlives it
  explicit Body(MemoryShare* share) : share_(share) {}
  Body(Body&& other) noexcept { swap(other); }
  Body& operator=(Body&& other) noexcept {
    Body taken(std::move(other));
    swap(taken);
    return *this;
  }
  ~Body() {
    if (memory_ != nullptr) release();
  }
  void swap(Body& other) noexcept {
    std::swap(share_, other.share_);
    std::swap(memory_, other.memory_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::byte* data() { return memory_; }
  const std::byte* data() const { return memory_; }
  std::span<const std::byte> bytes() const { return {memory_, size_}; }

  /// `count` more bytes at the end, for the caller to fill in.
  std::byte* extend(std::size_t count) {
    if (count > capacity_ - size_) grow(size_ + count);
    std::byte* const added = memory_ + size_;
    size_ += count;
    return added;
  }
  void append(std::span<const std::byte> bytes) {
    if (!bytes.empty()) std::memcpy(extend(bytes.size()), bytes.data(), bytes.size());
  }
  /// Takes back what was written behind the first `size` bytes.
  void truncate(std::size_t size) { size_ = std::min(size, size_); }
  void erase_front(std::size_t count) {
    if (count < size_) std::memmove(memory_, memory_ + count, size_ - count);
    size_ -= std::min(count, size_);
  }
  void clear() { size_ = 0; }
  void reserve(std::size_t capacity) {
    if (capacity > capacity_) grow(capacity);
  }
  std::size_t capacity() const { return capacity_; }
  /// Gives memory back that one large message asked for: where it is at most half used, and more
  /// than `most`.
  void shrink(std::size_t most) {
    if (capacity_ > most && size_ <= capacity_ / 2) give_back(most);
  }

 private:
  void grow(std::size_t least);
  void give_back(std::size_t most);
  void give_pages(std::byte* pages, std::size_t bytes);
  void release();

  MemoryShare* share_ = nullptr;
  std::byte* memory_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace armature::ride
