// SPDX-License-Identifier: Apache-2.0
#include "armature/vision/colour_threshold.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "armature/vision/hsv.hpp"
#include "armature/vision/internal/mistakes.hpp"

namespace armature::vision {
namespace {

constexpr double kSixth = std::numbers::pi / 3.0;
constexpr double kNever = 256.0;  // no pixel has that spread

// Without a branch, which noise would make the processor guess wrongly: half of the time of a mask.
int larger(int a, int b) { return a - ((a - b) & ((a - b) >> 31)); }
int smaller(int a, int b) { return b + ((a - b) & ((a - b) >> 31)); }

}  // namespace

base::Result<ColourThreshold> ColourThreshold::make(const Config& config) {
  internal::Mistakes mistakes("ColourThreshold");
  const Hsv wanted = hsv_of(config.wanted);
  mistakes.expect(wanted.saturation > 0.0, "wanted.saturation", wanted.saturation,
                  "above 0: a grey has no hue");
  // Hues that are further apart could lie on both sides of a greatest part's interval.
  mistakes.expect(config.hue_tolerance_rad > 0.0 && config.hue_tolerance_rad <= kSixth,
                  "hue_tolerance_rad", config.hue_tolerance_rad, "above 0, at most pi / 3");
  mistakes.expect_share("min_saturation", config.min_saturation);
  mistakes.expect_share("min_value", config.min_value);
  if (const auto checked = mistakes.result(); !checked) return base::Error{checked.error()};
  return ColourThreshold(config);
}

/// All that a pixel is compared with is a whole number, in a table.
ColourThreshold::ColourThreshold(const Config& config) : config_(config) {
  const double wanted = hsv_of(config.wanted).hue_rad / kSixth;
  const double tolerance = config.hue_tolerance_rad / kSixth;
  for (std::size_t shade = 0; shade < kShades; ++shade) {
    const auto number = static_cast<double>(shade);
    const bool dark = number < 255.0 * config.min_value;
    const double least = dark ? kNever : std::max(1.0, config.min_saturation * number);
    least_spread_[shade] = static_cast<std::int16_t>(std::ceil(least));
    for (std::size_t part = 0; part < near_.size(); ++part) {
      const double middle = std::remainder(wanted - 2.0 * static_cast<double>(part), 6.0);
      near_[part][shade] = {static_cast<std::int16_t>(std::ceil((middle - tolerance) * number)),
                            static_cast<std::int16_t>(std::floor((middle + tolerance) * number))};
    }
  }
}

double ColourThreshold::distance(Rgb pixel) const noexcept {
  const Hsv colour = hsv_of(pixel);
  if (colour.saturation < config_.min_saturation || colour.value < config_.min_value) return 1.0;
  return hue_distance(colour.hue_rad, hsv_of(config_.wanted).hue_rad) / std::numbers::pi;
}

bool ColourThreshold::holds(int red, int green, int blue) const noexcept {
  const int greatest = larger(larger(red, green), blue);
  const int spread = greatest - smaller(smaller(red, green), blue);
  if (spread < least_spread_[static_cast<std::size_t>(greatest)]) return false;
  const auto near = [this, spread](std::size_t part, int difference) {
    const Interval& interval = near_[part][static_cast<std::size_t>(spread)];
    return difference >= interval.low && difference <= interval.high;
  };
  if (greatest == red) return near(0, green - blue);
  if (greatest == green) return near(1, blue - red);
  return near(2, red - green);
}

void ColourThreshold::mask(const ImageView& image, std::span<std::uint8_t> mask) const noexcept {
  const std::uint8_t* pixel = image.data;
  for (std::uint8_t& place : mask) {
    place = holds(pixel[0], pixel[1], pixel[2]) ? 1 : 0;
    pixel += kBytesOfPixel;
  }
}

}  // namespace armature::vision
