// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "armature/base/result.hpp"
#include "armature/vision/image.hpp"

namespace armature::vision {

/// Tells pixels of a wanted colour from all others (paper 4, figure 5: the threshold vector is this
/// colour). A pixel has the colour if its hue is near, it is no grey and it is not black:
///
///     |hue - hue(wanted)| <= hue_tolerance, saturation >= min_saturation, value >= min_value
class ColourThreshold {
 public:
  /// What counts as the wanted colour.
  struct Config {
    Rgb wanted{255, 0, 0};           ///< no grey: a grey has no hue
    double hue_tolerance_rad = 0.2;  ///< > 0, <= pi / 3
    double min_saturation = 0.4;     ///< > 0, <= 1
    double min_value = 0.15;         ///< > 0, <= 1
  };

  /// An error names every field that is wrong, and what it should be.
  static base::Result<ColourThreshold> make(const Config& config);

  const Config& config() const { return config_; }

  /// @rt nonblocking, no allocation
  bool holds(Rgb pixel) const noexcept { return holds(pixel.red, pixel.green, pixel.blue); }
  /// How far a pixel is from the wanted colour, for people who look: 0 the same hue, 1 the opposite
  /// one, or too grey or too dark to have one.
  /// @rt nonblocking, no allocation
  double distance(Rgb pixel) const noexcept;
  /// @param mask  becomes 1 for each pixel that has the colour, otherwise 0; as many as the image
  /// has
  /// @rt nonblocking, no allocation, O(pixels)
  void mask(const ImageView& image, std::span<std::uint8_t> mask) const noexcept;

 private:
  /// Whole numbers from `low` to `high`.
  struct Interval {
    std::int16_t low = 0;
    std::int16_t high = 0;
  };
  static constexpr std::size_t kShades = 256;

  explicit ColourThreshold(const Config& config);
  bool holds(int red, int green, int blue) const noexcept;

  Config config_;
  /// By a pixel's greatest part: how much less its least part is at least.
  std::array<std::int16_t, kShades> least_spread_{};
  /// By which part is the greatest, and the difference to the least: that of the two behind it.
  std::array<std::array<Interval, kShades>, 3> near_{};
};

}  // namespace armature::vision
