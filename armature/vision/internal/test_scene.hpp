// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "armature/vision/image.hpp"

namespace armature::vision::test {

inline constexpr Rgb kRed{210, 40, 40};
inline constexpr Rgb kGrey{120, 120, 120};

/// Pictures whose truth is known: shapes with smooth edges on a grey floor.
class Scene {
 public:
  explicit Scene(ImageShape shape, Rgb floor = kGrey) : image_(shape) {
    for (int row = 0; row < shape.height; ++row) {
      for (int column = 0; column < shape.width; ++column) image_.set(column, row, floor);
    }
  }

  const Image& image() const { return image_; }
  ImageView view() const { return image_.view(); }

  /// Pixels at the edge are mixed by how much of them the disc covers.
  void disc(double x, double y, double radius, Rgb colour) {
    cover(x - radius, y - radius, x + radius, y + radius, colour, [=](double px, double py) {
      return (px - x) * (px - x) + (py - y) * (py - y) < radius * radius;
    });
  }
  void box(double left, double top, double right, double bottom, Rgb colour) {
    cover(left, top, right, bottom, colour, [=](double px, double py) {
      return px >= left && px < right && py >= top && py < bottom;
    });
  }
  /// Each part of each pixel is off by a normal distribution.
  void add_noise(double deviation, unsigned seed) {
    std::mt19937 source(seed);
    std::normal_distribution<double> noise(0.0, deviation);
    const auto off = [&](std::uint8_t part) { return byte_of(part + noise(source)); };
    for (int row = 0; row < image_.shape().height; ++row) {
      for (int column = 0; column < image_.shape().width; ++column) {
        const Rgb was = image_.at(column, row);
        image_.set(column, row, {off(was.red), off(was.green), off(was.blue)});
      }
    }
  }

 private:
  static constexpr int kSamples = 8;  // in each direction of a pixel

  static std::uint8_t byte_of(double part) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(part, 0.0, 255.0)));
  }
  static Rgb mixed(Rgb below, Rgb above, double share) {
    const auto part = [share](std::uint8_t a, std::uint8_t b) {
      return byte_of((1.0 - share) * a + share * b);
    };
    return {part(below.red, above.red), part(below.green, above.green),
            part(below.blue, above.blue)};
  }

  template <typename Inside>
  void cover(double left, double top, double right, double bottom, Rgb colour,
             const Inside& inside) {
    const int last_row = std::min(image_.shape().height, static_cast<int>(std::ceil(bottom)));
    const int last_column = std::min(image_.shape().width, static_cast<int>(std::ceil(right)));
    for (int row = std::max(0, static_cast<int>(std::floor(top))); row < last_row; ++row) {
      for (int column = std::max(0, static_cast<int>(std::floor(left))); column < last_column;
           ++column) {
        const double share = share_of_pixel(column, row, inside);
        if (share > 0.0) image_.set(column, row, mixed(image_.at(column, row), colour, share));
      }
    }
  }

  template <typename Inside>
  static double share_of_pixel(int column, int row, const Inside& inside) {
    int covered = 0;
    for (int down = 0; down < kSamples; ++down) {
      for (int right = 0; right < kSamples; ++right) {
        const double x = column + (right + 0.5) / kSamples;
        const double y = row + (down + 0.5) / kSamples;
        if (inside(x, y)) ++covered;
      }
    }
    return static_cast<double>(covered) / (kSamples * kSamples);
  }

  Image image_;
};

}  // namespace armature::vision::test
