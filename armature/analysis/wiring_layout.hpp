// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "armature/analysis/wiring.hpp"

/// Places a wiring on a plane: data flows from left to right, each thread is a lane of its own.
namespace armature::analysis {

/// A place on the plane, in pixels from the top left.
struct Point {
  double x = 0.0;
  double y = 0.0;
};

/// A component: a header of two lines, inputs below at the left, outputs and uses at the right.
struct Box {
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;
  std::vector<std::string> left;
  std::vector<std::string> right;
};

/// The way of an edge, from the right side of a box to the left side of another.
struct Way {
  std::vector<Point> points;
  bool backward = false;  ///< against the flow
};

/// The strip of a thread.
struct Lane {
  double y = 0.0;
  double height = 0.0;
};

/// Where everything of a wiring is drawn.
struct WiringLayout {
  std::vector<Box> boxes;   ///< as the nodes of the wiring
  std::vector<Way> ways;    ///< as its edges
  std::vector<Lane> lanes;  ///< as its threads
  double width = 0.0;
  double height = 0.0;
};

inline constexpr double kHeaderHeight = 40.0;
inline constexpr double kRowHeight = 16.0;
inline constexpr double kLaneTitleHeight = 26.0;
inline constexpr double kMargin = 16.0;

WiringLayout place(const Wiring& wiring);

/// Width of text in a sans-serif font of 12 pixels, roughly.
double text_width(std::string_view text);

}  // namespace armature::analysis
