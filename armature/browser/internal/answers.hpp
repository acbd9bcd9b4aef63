// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

#include "armature/browser/internal/surface.hpp"

namespace armature::browser::internal {

/// What lines are answered; counts those that were mistakes.
class Answers {
 public:
  /// @param surface  outlives it
  explicit Answers(Surface& surface) : surface_(surface) {}

  Surface& surface() { return surface_; }
  Paper paper() const { return surface_.paper(); }
  void say(std::string_view text) { surface_.say(text); }

  /// Tells of a mistake and counts it.
  void mistake(std::string_view text);
  /// Likewise of one that was told.
  void count_mistake() { ++mistakes_; }
  std::size_t mistakes() const { return mistakes_; }

 private:
  Surface& surface_;
  std::size_t mistakes_ = 0;
};

}  // namespace armature::browser::internal
