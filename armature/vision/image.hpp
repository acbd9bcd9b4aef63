// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace armature::vision {

/// A colour, each part 0 to 255.
struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  bool operator==(const Rgb&) const = default;
};

/// Bytes of a pixel: red, green, blue.
inline constexpr std::size_t kBytesOfPixel = 3;

/// How many pixels an image has.
struct ImageShape {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]

  std::size_t pixels() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  std::size_t bytes() const { return kBytesOfPixel * pixels(); }
  bool operator==(const ImageShape&) const = default;
};

/// An image in memory that somebody else keeps: red, green, blue of each pixel, a row after the
/// other, the upper one first.
struct ImageView {
  const std::uint8_t* data = nullptr;  ///< `shape.bytes()` of them
  ImageShape shape;
};

/// An image with its memory.
class Image {
 public:
  /// All black.
  explicit Image(ImageShape shape) : shape_(shape), bytes_(shape.bytes()) {}

  const ImageShape& shape() const { return shape_; }
  ImageView view() const { return {bytes_.data(), shape_}; }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

  /// @param column  [px] to the right, from 0
  /// @param row     [px] downwards, from 0; both inside of the image
  Rgb at(int column, int row) const {
    const std::uint8_t* const pixel = bytes_.data() + place_of(column, row);
    return {pixel[0], pixel[1], pixel[2]};
  }
  void set(int column, int row, Rgb colour) {
    std::uint8_t* const pixel = bytes_.data() + place_of(column, row);
    pixel[0] = colour.red;
    pixel[1] = colour.green;
    pixel[2] = colour.blue;
  }

 private:
  std::size_t place_of(int column, int row) const {
    return kBytesOfPixel * (static_cast<std::size_t>(row) * static_cast<std::size_t>(shape_.width) +
                            static_cast<std::size_t>(column));
  }

  ImageShape shape_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace armature::vision
