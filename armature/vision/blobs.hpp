// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "armature/vision/image.hpp"

namespace armature::vision {

/// Pixels from `left` and `top` on, to before `right` and `bottom`.
struct Box {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;

  int area() const { return (right - left) * (bottom - top); }
  bool operator==(const Box&) const = default;
};

/// Pixels that touch each other, also at their corners.
struct Blob {
  int area = 0;  ///< [px]
  Box box;
  std::int64_t columns = 0;  ///< sum of those of its pixels
  std::int64_t rows = 0;

  /// Middle of its area [px], from the left edge of the picture, whose first pixel is 0 to 1.
  double x() const { return static_cast<double>(columns) / area + 0.5; }
  /// Likewise from the upper edge downwards.
  double y() const { return static_cast<double>(rows) / area + 0.5; }
  /// Share of its box that it fills: a disc pi / 4, a rectangle 1.
  double fill() const { return static_cast<double>(area) / box.area(); }
};

/// Finds the blobs of masks of one shape: runs of pixels in each row are united with those they
/// touch in the row above.
class BlobFinder {
 public:
  /// Neighbouring pixels of a row.
  struct Run {
    int row = 0;
    int begin = 0;  ///< first column
    int end = 0;    ///< column behind the last
    int blob = 0;   ///< index into what `find` returned
  };

  /// Allocates for the worst mask.
  /// @param shape  width and height > 0
  explicit BlobFinder(ImageShape shape);

  /// @param mask  0 for what belongs to no blob; as many as the shape has
  /// @return valid until the next call, in the order of their first pixels
  /// @rt nonblocking, no allocation, O(pixels)
  std::span<const Blob> find(std::span<const std::uint8_t> mask) noexcept;
  /// Of the last call, a row after the other.
  std::span<const Run> runs() const { return runs_; }

 private:
  void add_runs_of(int row, const std::uint8_t* pixels) noexcept;
  void add(Run run) noexcept;
  int label_of(const Run& run) noexcept;
  int root_of(int label) noexcept;
  int unite(int a, int b) noexcept;
  void keep_roots() noexcept;

  ImageShape shape_;
  std::vector<Run> runs_;
  std::vector<Blob> blobs_;   ///< by label, until only roots are kept
  std::vector<int> parents_;  ///< by label; of a root itself
  std::size_t above_ = 0;     ///< the first run of the row above that may touch the next run
  std::size_t row_begin_ = 0;
};

}  // namespace armature::vision
