// SPDX-License-Identifier: Apache-2.0
#include "armature/vision/ball_finder.hpp"

#include "armature/vision/internal/mistakes.hpp"

namespace armature::vision {

base::Result<BallFinder> BallFinder::make(const Config& config) {
  internal::Mistakes mistakes("BallFinder");
  mistakes.expect_positive("shape.width", config.shape.width);
  mistakes.expect_positive("shape.height", config.shape.height);
  mistakes.expect_positive("min_area", config.min_area);
  mistakes.expect_share("min_fill", config.min_fill);
  mistakes.expect_share("max_fill", config.max_fill);
  mistakes.expect(config.min_fill < config.max_fill, "min_fill", config.min_fill,
                  "less than max_fill");
  if (const auto checked = mistakes.result(); !checked) return base::Error{checked.error()};
  auto threshold = ColourThreshold::make(config.colour);
  if (!threshold) return base::Error{threshold.error()};
  return BallFinder(config, threshold.value());
}

BallFinder::BallFinder(const Config& config, const ColourThreshold& threshold)
    : config_(config),
      threshold_(threshold),
      mask_(config.shape.pixels()),
      blob_finder_(config.shape) {}

std::optional<BallFinder::Ball> BallFinder::find(const ImageView& image) noexcept {
  threshold_.mask(image, mask_);
  found_ = blob_finder_.find(mask_);
  std::optional<Ball> largest;
  for (std::size_t i = 0; i < found_.size(); ++i) {
    const Blob& blob = found_[i];
    if (blob.area < config_.min_area || !is_round(blob)) continue;
    if (largest && largest->area >= blob.area) continue;
    largest = Ball{blob.x(), blob.y(), blob.area, is_cut(blob), i};
  }
  return largest;
}

bool BallFinder::is_round(const Blob& blob) const noexcept {
  return blob.fill() >= config_.min_fill && blob.fill() <= config_.max_fill;
}

bool BallFinder::is_cut(const Blob& blob) const noexcept {
  return blob.box.left == 0 || blob.box.top == 0 || blob.box.right == config_.shape.width ||
         blob.box.bottom == config_.shape.height;
}

}  // namespace armature::vision
