// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/bridge/bridge.hpp"

#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"

namespace armature::controllers {
namespace {

using ::testing::ElementsAre;

using Vector = std::vector<double>;

class PaperTwosBridge : public ::testing::Test {
 protected:
  PaperTwosBridge() { bridge.set("joints", 2); }

  testing::Harness bridge{std::make_unique<Bridge>("Bridge")};
};

TEST_F(PaperTwosBridge, WritesAllPositionsWithEachThatComesOnceAllHaveCome) {
  ASSERT_TRUE(bridge.start()) << bridge.reason();
  bridge.write("Position2", 2.0);
  bridge.write("Position2", 2.5);
  EXPECT_EQ(bridge.writes("nAxesSensorPosition"), 0u);
  bridge.write("Position1", 1.0);
  EXPECT_THAT(bridge.output<Vector>("nAxesSensorPosition"), ElementsAre(1.0, 2.5));
  bridge.write("Position2", 3.0);
  EXPECT_THAT(bridge.output<Vector>("nAxesSensorPosition"), ElementsAre(1.0, 3.0));
  EXPECT_EQ(bridge.writes("nAxesSensorPosition"), 2u);
}

TEST_F(PaperTwosBridge, PositionsFromBeforeAStartDoNotCount) {
  ASSERT_TRUE(bridge.start()) << bridge.reason();
  bridge.write("Position1", 1.0);
  bridge.write("Position2", 2.0);
  bridge.stop();
  ASSERT_TRUE(bridge.start()) << bridge.reason();
  bridge.write("Position1", 1.5);
  EXPECT_EQ(bridge.writes("nAxesSensorPosition"), 1u);
}

TEST_F(PaperTwosBridge, HandsOutWhatIsDesired) {
  ASSERT_TRUE(bridge.start()) << bridge.reason();
  bridge.write("nAxesDesiredPosition", Vector{0.5, 0.7});
  EXPECT_EQ(bridge.output<double>("Ref1"), 0.5);
  EXPECT_EQ(bridge.output<double>("Ref2"), 0.7);
}

}  // namespace
}  // namespace armature::controllers
