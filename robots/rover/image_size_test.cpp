// SPDX-License-Identifier: Apache-2.0
#include "robots/rover/image_size.hpp"

#include <cstdint>
#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"

namespace armature::rover {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class Screen final : public component::Component {
 public:
  using Component::Component;

  component::Property<int> width{this, "ImageWidth", 4, "", "px", kImageSide};
  component::Property<int> height{this, "ImageHeight", 3, "", "px", kImageSide};
  ImageSize size{this, width, height};
  component::InputPort<std::vector<std::uint8_t>> image{this, "Image", "", "",
                                                        component::size_of(size.bytes())};
};

TEST(ImageSize, FollowsWidthAndHeight) {
  auto owned = std::make_unique<Screen>("Screen");
  const Screen& screen = *owned;
  testing::Harness bench(std::move(owned));
  EXPECT_EQ(face(screen.image).declared_size().value(), 36u);
  bench.set("ImageWidth", 320);
  bench.set("ImageHeight", 240);
  EXPECT_EQ(face(screen.image).declared_size().value(), 320u * 240u * 3u);
}

TEST(ImageSize, IsSetByWidthAndHeightOnly) {
  testing::Harness bench(std::make_unique<Screen>("Screen"));
  EXPECT_THAT([&] { bench.set("ImageBytes", 12); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("it follows from ImageWidth and ImageHeight: set these")));
}

TEST(ImageSize, StaysOnceTheComponentIsConfigured) {
  testing::Harness bench(std::make_unique<Screen>("Screen"));
  ASSERT_TRUE(bench.start());
  bench.stop();
  EXPECT_THAT(
      [&] { bench.set("ImageWidth", 8); },
      ThrowsMessage<std::invalid_argument>(HasSubstr("before the component is configured")));
}

}  // namespace
}  // namespace armature::rover
