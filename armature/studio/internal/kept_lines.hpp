// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <utility>
#include <vector>

namespace armature::studio::internal {

/// The newest lines of a log, with numbers that go on from run to run.
class KeptLines {
 public:
  static constexpr std::size_t kMost = 10'000;

  void add(std::string line) {
    lines_.push_back(std::move(line));
    if (lines_.size() <= kMost) return;
    lines_.pop_front();
    ++begin_;
  }
  /// Of another run.
  void begin_anew() {
    begin_ = end();
    lines_.clear();
  }

  std::int32_t begin() const { return begin_; }
  std::int32_t end() const { return begin_ + static_cast<std::int32_t>(lines_.size()); }
  /// From line `from` on, at most `count`.
  std::vector<std::string> lines(std::int32_t from, std::size_t count) const {
    const auto first = static_cast<std::size_t>(std::clamp(from, begin(), end()) - begin());
    const std::size_t last = std::min(lines_.size(), first + count);
    return {lines_.begin() + static_cast<std::ptrdiff_t>(first),
            lines_.begin() + static_cast<std::ptrdiff_t>(last)};
  }

 private:
  std::deque<std::string> lines_;
  std::int32_t begin_ = 0;
};

}  // namespace armature::studio::internal
