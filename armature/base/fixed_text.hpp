// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>

namespace armature::base {

/// Text of at most `Capacity` bytes that lives in place; longer text is cut at the end.
/// @rt nonblocking, no allocation, O(Capacity)
template <std::size_t Capacity>
class FixedText {
 public:
  constexpr FixedText() = default;
  template <std::convertible_to<std::string_view> Text>
  constexpr FixedText(const Text& text) {  // NOLINT: text is text
    assign(text);
  }

  constexpr void assign(std::string_view text) {
    size_ = std::min(text.size(), Capacity);
    std::copy_n(text.data(), size_, bytes_.data());
  }
  constexpr FixedText& append(std::string_view text) {
    const std::size_t taken = std::min(text.size(), Capacity - size_);
    std::copy_n(text.data(), taken, bytes_.data() + size_);
    size_ += taken;
    return *this;
  }
  constexpr void clear() { size_ = 0; }

  constexpr std::string_view view() const { return {bytes_.data(), size_}; }
  constexpr bool empty() const { return size_ == 0; }
  constexpr operator std::string_view() const { return view(); }  // NOLINT

  friend constexpr bool operator==(const FixedText& a, const FixedText& b) {
    return a.view() == b.view();
  }

 private:
  std::size_t size_ = 0;
  std::array<char, Capacity> bytes_{};
};

}  // namespace armature::base
