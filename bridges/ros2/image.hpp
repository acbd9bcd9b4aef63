// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bridges/ros2/endpoint.hpp"
#include "bridges/ros2/internal/feed.hpp"

namespace armature::ros2 {

/// Images of a camera, as sensor_msgs/CompressedImage in PNG: one message for each image.
class Image final : public Publisher {
 public:
  using Publisher::Publisher;

 private:
  using Pixels = std::vector<std::uint8_t>;

  std::string open(const component::Surroundings& surroundings) override;
  void close() override;
  void begin() override;
  void work() override;
  void publish_image(const Pixels& pixels, base::Time at);

  component::Property<int> width_{
      this, "ImageWidth", 320, "of the images that come", "px", component::range(1, 10000)};
  component::Property<int> height_{this,       "ImageHeight", 240,
                                   "likewise", "px",          component::range(1, 10000)};
  component::Property<std::string> frame_{this, "frame_id", "camera", "of the header"};
  component::Property<std::string> topic_{this, "topic", "image/compressed", "that it writes"};
  component::Property<int> buffer_{this, "buffer",
                                   4,    "images that wait at most, between two updates",
                                   "",   component::range(1, 1000)};
  component::InputPort<Pixels> image_{this, "Image",
                                      "red, green, blue of each pixel, the upper row first", "",
                                      component::on_lost(component::Reaction::kHold)};

  internal::Feed images_;
  std::unique_ptr<Writer> writer_;
};

}  // namespace armature::ros2
