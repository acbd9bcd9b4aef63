// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/vision/image.hpp"

namespace armature::vision {

/// A colour by hue, saturation and value: shade and light change the value and leave the hue.
struct Hsv {
  double hue_rad = 0.0;     ///< -pi < hue <= pi; 0 red, 2 pi / 3 green, -2 pi / 3 blue; of greys 0
  double saturation = 0.0;  ///< 0 (grey) to 1
  double value = 0.0;       ///< 0 (black) to 1
};

/// @rt nonblocking, no allocation
Hsv hsv_of(Rgb colour) noexcept;

/// The way from one hue to the other, 0 to pi.
/// @rt nonblocking, no allocation
double hue_distance(double a_rad, double b_rad) noexcept;

}  // namespace armature::vision
