// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/image.hpp"

#include "armature/component/face.hpp"
#include "armature/vision/png.hpp"
#include "bridges/ros2/internal/dds.hpp"
#include "bridges/ros2/internal/messages.hpp"

namespace armature::ros2 {

std::string Image::open(const component::Surroundings& /*surroundings*/) {
  writer_ = writer(topic_, sensor_msgs_msg_dds__CompressedImage__desc, {.depth = 2});
  images_.follow(face(image_), static_cast<std::size_t>(buffer_.get()));
  return {};
}

void Image::close() {
  writer_.reset();
  images_.end();
}

void Image::begin() {
  Publisher::begin();
  images_.skip();
}

void Image::work() {
  types::Value value(types::type_of<Pixels>());
  while (const auto at = images_.take_before(base::Time::max(), value)) {
    publish_image(*static_cast<const Pixels*>(value.data()), *at);
  }
  count_lost(images_.take_dropped());
  tell();
}

void Image::publish_image(const Pixels& pixels, base::Time at) {
  const vision::ImageView view{pixels.data(), {width_, height_}};
  if (pixels.size() != view.shape.bytes()) return count_lost(1);
  const std::string png = vision::png_of(view);
  std::vector<std::uint8_t> bytes(png.begin(), png.end());
  const std::string format = "png";
  sensor_msgs_msg_dds__CompressedImage_ message{};
  message.header = internal::header_of(node().stamp_of(at), frame_);
  message.format = internal::lend(format);
  internal::lend(bytes, message.data);
  publish(*writer_, &message);
}

}  // namespace armature::ros2
