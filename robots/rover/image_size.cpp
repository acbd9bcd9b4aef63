// SPDX-License-Identifier: Apache-2.0
#include "robots/rover/image_size.hpp"

namespace armature::rover {

ImageSize::ImageSize(component::Component* owner, component::Property<int>& width,
                     component::Property<int>& height)
    : owner_(*owner),
      width_(width),
      height_(height),
      bytes_(owner, "ImageBytes", kBytesOfPixel * width.get() * height.get(),
             "of an image: three for each pixel") {
  width.add_follower(*this);
  height.add_follower(*this);
  bytes_.add_follower(*this);
}

void ImageSize::follow() {
  const int bytes = kBytesOfPixel * width_.get() * height_.get();
  if (bytes_.get() != bytes) bytes_.assign(bytes);  // which comes here again
}

std::string ImageSize::objection() const {
  if (!owner_.is_configured()) return {};
  return "the ports for images have their size: set it before the component is configured";
}

std::string ImageSize::objection_to(const component::PropertyBase& property,
                                    const types::Value& /*value*/) const {
  if (&property != &bytes_) return {};
  return "it follows from " + std::string(width_.name()) + " and " + std::string(height_.name()) +
         ": set these";
}

}  // namespace armature::rover
