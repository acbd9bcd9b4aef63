// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace armature::exec::internal {

/// Values in numbered groups, such as the edges of a graph by the node that they begin at. All of
/// them lie in one piece of memory, in the order of their groups and, in a group, of `add`.
template <typename T>
class Grouped {
 public:
  explicit Grouped(std::size_t groups) : begin_(groups + 1, 0) {}

  std::size_t groups() const { return begin_.size() - 1; }

  void add(std::size_t group, const T& value) {
    added_.emplace_back(group, value);
    ++begin_[group + 1];
  }

  /// To be called once, after the last `add` and before the first look.
  void close() {
    for (std::size_t group = 1; group < begin_.size(); ++group) begin_[group] += begin_[group - 1];
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    values_.resize(added_.size());
    for (const auto& [group, value] : added_) values_[next[group]++] = value;
    added_ = {};
  }

  std::span<const T> operator[](std::size_t group) const {
    return std::span<const T>(values_).subspan(begin_[group], begin_[group + 1] - begin_[group]);
  }

 private:
  std::vector<std::pair<std::size_t, T>> added_;
  std::vector<std::size_t> begin_;  ///< of each group; of the one before while values are added
  std::vector<T> values_;
};

}  // namespace armature::exec::internal
