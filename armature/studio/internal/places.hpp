// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "armature/base/result.hpp"

namespace armature::studio::internal {

/// Where a box is on the canvas, in steps of the grid's 8 pixels.
struct BoxPlace {
  std::int32_t x = 0;
  std::int32_t y = 0;
};

/// Where boxes are: the file `FILE.studio.json` beside a deployment, sorted, a line for each box,
/// so that what two people moved merges.
class Places {
 public:
  static constexpr std::int32_t kGrid = 8;

  /// Of the file's text; empty: no box has a place. The error says what is wrong with it.
  static base::Result<Places> parse(const std::string& text);

  /// Coordinates in pixels go to the next step of the grid.
  void set(const std::string& box, double x, double y);
  void rename(const std::string& from, const std::string& to);
  /// What is inside of a box stands beside it, and the box goes.
  void dissolve(const std::string& box);
  void remove(const std::string& box) { boxes_.erase(box); }

  bool empty() const { return boxes_.empty(); }
  std::string to_text() const;

 private:
  std::map<std::string, BoxPlace> boxes_;
};

}  // namespace armature::studio::internal
