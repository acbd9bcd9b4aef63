// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/vision/blobs.hpp"
#include "armature/vision/colour_threshold.hpp"
#include "armature/vision/image.hpp"

namespace armature::vision {

/// Finds a ball of one colour in images of one shape (paper 4, figure 5): the mask of its colour,
/// the blobs of the mask, and of those that are large and round enough the largest.
///
/// A ball that the picture's border cuts, or something before it hides in part, has the middle of
/// what is seen of it: wrong by less than its radius, and on the side on which it is. Whoever
/// follows a ball turns the right way by that, and the border moves off it. `cut` tells it apart.
class BallFinder {
 public:
  /// What counts as a ball.
  struct Config {
    ImageShape shape{320, 240};
    ColourThreshold::Config colour{};
    int min_area = 20;       ///< [px] > 0
    double min_fill = 0.6;   ///< least share of its box that it fills; a disc fills pi / 4
    double max_fill = 0.95;  ///< greatest; a rectangle fills 1
  };

  /// A ball in the picture.
  struct Ball {
    double x = 0.0;        ///< centre [px] to the right, from the picture's left edge
    double y = 0.0;        ///< [px] downwards, from the upper edge
    int area = 0;          ///< [px]
    bool cut = false;      ///< it touches the picture's border, so part of it may be outside
    std::size_t blob = 0;  ///< index into blobs()
  };

  /// An error names every field that is wrong, and what it should be.
  static base::Result<BallFinder> make(const Config& config);

  const Config& config() const { return config_; }
  /// Looks for another colour from now on.
  /// @rt nonblocking, no allocation
  void look_for(const ColourThreshold& colour) noexcept { threshold_ = colour; }
  const ColourThreshold& threshold() const { return threshold_; }

  /// @param image  of the configured shape
  /// @return nothing: no ball is in sight
  /// @rt nonblocking, no allocation, O(pixels)
  std::optional<Ball> find(const ImageView& image) noexcept;

  /// What the last image had on the way to the ball, for those who look (stages.hpp).
  std::span<const std::uint8_t> mask() const { return mask_; }
  std::span<const Blob> blobs() const { return found_; }
  std::span<const BlobFinder::Run> runs() const { return blob_finder_.runs(); }

 private:
  BallFinder(const Config& config, const ColourThreshold& threshold);
  bool is_round(const Blob& blob) const noexcept;
  bool is_cut(const Blob& blob) const noexcept;

  Config config_;
  ColourThreshold threshold_;
  std::vector<std::uint8_t> mask_;
  BlobFinder blob_finder_;
  std::span<const Blob> found_{};
};

}  // namespace armature::vision
