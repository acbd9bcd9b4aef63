// SPDX-License-Identifier: Apache-2.0
#include "armature/vision/hsv.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace armature::vision {
namespace {

constexpr double kPi = std::numbers::pi;

/// -1 < hue <= 5, in sixths of the circle.
double hue_in_sixths(double red, double green, double blue, double greatest, double spread) {
  if (greatest == red) return (green - blue) / spread;
  if (greatest == green) return 2.0 + (blue - red) / spread;
  return 4.0 + (red - green) / spread;
}

}  // namespace

Hsv hsv_of(Rgb colour) noexcept {
  const double red = colour.red;
  const double green = colour.green;
  const double blue = colour.blue;
  const double greatest = std::max({red, green, blue});
  const double spread = greatest - std::min({red, green, blue});
  if (spread == 0.0) return {0.0, 0.0, greatest / 255.0};
  const double sixths = hue_in_sixths(red, green, blue, greatest, spread);
  const double hue = sixths * kPi / 3.0;
  return {hue > kPi ? hue - 2.0 * kPi : hue, spread / greatest, greatest / 255.0};
}

double hue_distance(double a_rad, double b_rad) noexcept {
  return std::abs(std::remainder(a_rad - b_rad, 2.0 * kPi));
}

}  // namespace armature::vision
