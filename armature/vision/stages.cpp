// SPDX-License-Identifier: Apache-2.0
#include "armature/vision/stages.hpp"

#include <array>
#include <cmath>

namespace armature::vision {
namespace {

constexpr Rgb kWhite{255, 255, 255};
constexpr Rgb kMark{0, 255, 0};
constexpr std::array<Rgb, 6> kBlobColours{Rgb{230, 80, 60},  Rgb{70, 130, 230}, Rgb{240, 190, 50},
                                          Rgb{90, 190, 110}, Rgb{170, 90, 200}, Rgb{80, 200, 210}};
constexpr int kCross = 6;  // half of its width [px]

Rgb pixel_of(const ImageView& image, int column, int row) {
  const std::uint8_t* const pixel =
      image.data +
      kBytesOfPixel * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.shape.width) +
                       static_cast<std::size_t>(column));
  return {pixel[0], pixel[1], pixel[2]};
}

/// `colour(column, row)` for each pixel.
template <typename Colour>
Image painted(ImageShape shape, const Colour& colour) {
  Image image(shape);
  for (int row = 0; row < shape.height; ++row) {
    for (int column = 0; column < shape.width; ++column)
      image.set(column, row, colour(column, row));
  }
  return image;
}

void mark(Image& image, int column, int row) {
  const bool inside =
      column >= 0 && row >= 0 && column < image.shape().width && row < image.shape().height;
  if (inside) image.set(column, row, kMark);
}

/// Just outside of the box, so that what it frames is seen whole.
void draw_frame(Image& image, const Box& box) {
  for (int column = box.left - 1; column <= box.right; ++column) {
    mark(image, column, box.top - 1);
    mark(image, column, box.bottom);
  }
  for (int row = box.top; row < box.bottom; ++row) {
    mark(image, box.left - 1, row);
    mark(image, box.right, row);
  }
}

void draw_cross(Image& image, double x, double y) {
  const int column = static_cast<int>(std::floor(x));
  const int row = static_cast<int>(std::floor(y));
  for (int i = -kCross; i <= kCross; ++i) {
    mark(image, column + i, row);
    mark(image, column, row + i);
  }
}

}  // namespace

Image colour_distance_image(const ColourThreshold& threshold, const ImageView& image) {
  return painted(image.shape, [&](int column, int row) {
    const double near = 1.0 - threshold.distance(pixel_of(image, column, row));
    const auto grey = static_cast<std::uint8_t>(std::lround(255.0 * near));
    return Rgb{grey, grey, grey};
  });
}

Image mask_image(const BallFinder& finder) {
  auto place = finder.mask().begin();
  return painted(finder.config().shape, [&](int, int) { return *place++ != 0 ? kWhite : Rgb{}; });
}

Image blob_image(const BallFinder& finder) {
  Image image(finder.config().shape);
  for (const BlobFinder::Run& run : finder.runs()) {
    const Rgb colour = kBlobColours[static_cast<std::size_t>(run.blob) % kBlobColours.size()];
    for (int column = run.begin; column < run.end; ++column) image.set(column, run.row, colour);
  }
  return image;
}

Image ball_image(const ImageView& image, const BallFinder& finder,
                 const std::optional<BallFinder::Ball>& ball) {
  Image marked =
      painted(image.shape, [&](int column, int row) { return pixel_of(image, column, row); });
  if (!ball) return marked;
  draw_frame(marked, finder.blobs()[ball->blob].box);
  draw_cross(marked, ball->x, ball->y);
  return marked;
}

}  // namespace armature::vision
