// SPDX-License-Identifier: Apache-2.0
#pragma once

// The stages of the recognition as images for people (paper 4, figure 5). They allocate, and are
// not for real-time code.

#include <optional>

#include "armature/vision/ball_finder.hpp"
#include "armature/vision/image.hpp"

namespace armature::vision {

/// White where a pixel has the wanted hue, black where it has the opposite one or none.
Image colour_distance_image(const ColourThreshold& threshold, const ImageView& image);
/// White where the last image that `finder` looked at has the wanted colour.
Image mask_image(const BallFinder& finder);
/// The blobs of that image, each with a colour of its own.
Image blob_image(const BallFinder& finder);
/// `image` with a frame around the ball and a cross at its centre.
Image ball_image(const ImageView& image, const BallFinder& finder,
                 const std::optional<BallFinder::Ball>& ball);

}  // namespace armature::vision
