// SPDX-License-Identifier: Apache-2.0
#include "armature/record/console_writer.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/record/internal/test_types.hpp"

namespace armature::record {
namespace {

using testing::HasSubstr;

TEST(ConsoleWriter, WritesALineForEachSample) {
  std::ostringstream to;
  ConsoleWriter writer(to);
  ASSERT_TRUE(writer.add_channel(channel_of("PID1.Out", 0.0, "V")));
  ASSERT_TRUE(writer.add_channel(channel_of("Head.pose", Pose{})));
  ASSERT_TRUE(write(writer, 0, 10'000'000, 0.5));
  ASSERT_TRUE(write(writer, 1, 10'000'000, Pose{1, 2}));
  EXPECT_EQ(writer.unsaved(), 2u);
  ASSERT_TRUE(writer.close());
  EXPECT_EQ(writer.unsaved(), 0u);
  EXPECT_EQ(to.str(), "0.010000000 PID1.Out 0.5 V\n0.010000000 Head.pose {x: 1, y: 2}\n");
}

TEST(ConsoleWriter, RefusesASampleThatDoesNotFitAndContinues) {
  std::ostringstream to;
  ConsoleWriter writer(to);
  ASSERT_TRUE(writer.add_channel(channel_of("A", 0.0)));
  EXPECT_THAT(write(writer, 1, 0, 0.5).error(), HasSubstr("'console'"));
  EXPECT_FALSE(writer.given_up());
  EXPECT_TRUE(write(writer, 0, 0, 0.5));
}

TEST(ConsoleWriter, SaysThatNobodyListens) {
  std::ostringstream to;
  ConsoleWriter writer(to);
  ASSERT_TRUE(writer.add_channel(channel_of("A", 0.0)));
  to.setstate(std::ios::badbit);
  EXPECT_FALSE(write(writer, 0, 0, 0.5));
  EXPECT_TRUE(writer.given_up());
  EXPECT_FALSE(writer.flush());
}

}  // namespace
}  // namespace armature::record
