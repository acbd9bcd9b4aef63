// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/component/author.hpp"

namespace armature::rover {

/// The size of a port that carries images, red, green and blue of each pixel: it follows from the
/// properties for width and height, so the check of a deployment compares it with that of the
/// other end. Both properties stay as they are once the component is configured.
///
///     ImageSize size_{this, width_, height_};
///     InputPort<std::vector<std::uint8_t>> image_{this, "Image", "...", "",
///     size_of(size_.bytes())};
class ImageSize final : public component::PropertyFollower {
 public:
  ImageSize(component::Component* owner, component::Property<int>& width,
            component::Property<int>& height);
  ImageSize(const ImageSize&) = delete;
  ImageSize& operator=(const ImageSize&) = delete;

  const component::Property<int>& bytes() const { return bytes_; }

  void follow() override;
  std::string objection() const override;
  std::string objection_to(const component::PropertyBase& property,
                           const types::Value& value) const override;

 private:
  static constexpr int kBytesOfPixel = 3;

  const component::Component& owner_;
  const component::Property<int>& width_;
  const component::Property<int>& height_;
  component::Attribute<int> bytes_;
};

/// As many pixels as an image may have in each direction, so that a picture stays below 13 MB.
inline constexpr component::Range kImageSide{1, 2048};

}  // namespace armature::rover
