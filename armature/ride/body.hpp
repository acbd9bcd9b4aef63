// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <utility>

namespace armature::ride {

/// Bytes that are written at the end, and kept to be used again: memory is asked for only when it
/// has to hold more than ever before.
/// @thread one at a time
class Body {
 public:
  Body() = default;
  Body(Body&& other) noexcept { swap(other); }
  Body& operator=(Body&& other) noexcept {
    Body taken(std::move(other));
    swap(taken);
    return *this;
  }
  void swap(Body& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::byte* data() { return memory_.get(); }
  const std::byte* data() const { return memory_.get(); }
  std::span<const std::byte> bytes() const { return {memory_.get(), size_}; }

  /// `count` more bytes at the end, for the caller to fill in.
  std::byte* extend(std::size_t count) {
    if (count > capacity_ - size_) grow(size_ + count);
    std::byte* const added = memory_.get() + size_;
    size_ += count;
    return added;
  }
  void append(std::span<const std::byte> bytes) {
    if (!bytes.empty()) std::memcpy(extend(bytes.size()), bytes.data(), bytes.size());
  }
  /// Takes back what was written behind the first `size` bytes.
  void truncate(std::size_t size) { size_ = std::min(size, size_); }
  void erase_front(std::size_t count) {
    if (count < size_) std::memmove(memory_.get(), memory_.get() + count, size_ - count);
    size_ -= std::min(count, size_);
  }
  void clear() { size_ = 0; }
  void reserve(std::size_t capacity) {
    if (capacity > capacity_) grow(capacity);
  }
  std::size_t capacity() const { return capacity_; }
  /// Gives memory back that one large message asked for; only what is empty does.
  void shrink(std::size_t most) {
    if (empty() && capacity_ > most) *this = Body();
  }

 private:
  void grow(std::size_t least) {
    const std::size_t capacity = std::max({least, 2 * capacity_, std::size_t{64}});
    void* const memory = std::realloc(memory_.get(), capacity);  // Large ones move without a copy.
    if (memory == nullptr) throw std::bad_alloc();
    static_cast<void>(memory_.release());
    memory_.reset(static_cast<std::byte*>(memory));
    capacity_ = capacity;
  }

  struct Free {
    void operator()(std::byte* memory) const { std::free(memory); }
  };

  std::unique_ptr<std::byte[], Free> memory_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace armature::ride
