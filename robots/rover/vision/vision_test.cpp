// SPDX-License-Identifier: Apache-2.0
#include "robots/rover/vision/vision.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"
#include "armature/testing/realtime_guard.hpp"

namespace armature::rover {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Position = std::tuple<std::int32_t, std::int32_t>;
using Failure = std::tuple<base::FixedText<31>, base::FixedText<127>>;

constexpr vision::Rgb kRed{220, 30, 30};
constexpr vision::Rgb kBlue{30, 30, 220};

/// Vision on a bench, with a camera of 64 x 48 pixels and 20 images a second. Each image differs
/// from the one before in one grey pixel, as noise makes them.
class VisionTest : public ::testing::Test {
 protected:
  static constexpr int kWidth = 64;
  static constexpr int kHeight = 48;

  VisionTest() {
    bench_.set("ImageWidth", kWidth);
    bench_.set("ImageHeight", kHeight);
    start();
  }

  void start() { ASSERT_TRUE(bench_.start()) << bench_.reason(); }
  void make_ready() {
    show_floor();
    ASSERT_EQ(initialize(), Vision::kDone);
  }
  void make_recognise() {
    make_ready();
    ASSERT_TRUE(bench_.call("start"));
  }

  std::int32_t initialize() { return bench_.call<std::int32_t>("initialize").value(); }
  std::int32_t set_threshold(std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
    return bench_.call<std::int32_t>("setThreshold", red, green, blue).value();
  }

  void show(const vision::Image& image) {
    bench_.run_cycles();
    bench_.write("Image", image.bytes());
  }
  void show_floor() { show(floor()); }
  void show_ball(int x, int y, vision::Rgb colour = kRed) { show(ball(x, y, colour)); }
  /// A square with cut corners, which fills 0.9 of its box.
  vision::Image ball(int x, int y, vision::Rgb colour = kRed) {
    vision::Image image = floor();
    for (int row = y - 6; row < y + 6; ++row) {
      for (int column = x - 6; column < x + 6; ++column) {
        const bool corner = std::abs(2 * (column - x) + 1) + std::abs(2 * (row - y) + 1) > 17;
        if (!corner) image.set(column, row, colour);
      }
    }
    return image;
  }
  vision::Image floor() {
    ++images_;
    vision::Image image({kWidth, kHeight});
    const auto grey = static_cast<std::uint8_t>(images_ % 200);
    image.set(0, 0, {grey, grey, grey});
    return image;
  }

  std::string_view is_in() {
    return component::interface_of(bench_.component()).machines.front()->path();
  }

  testing::Harness bench_{std::make_unique<Vision>("Vision"), 50ms};
  int images_ = 0;
};

// --- what it sees --------------------------------------------------------------------------------

TEST_F(VisionTest, TellsWhereTheBallIsFromTheLowerLeftCorner) {
  const auto& positions = bench_.record<std::int32_t, std::int32_t>("ObjectPositionEvent");
  make_recognise();
  show_ball(20, 10);
  EXPECT_THAT(positions, ElementsAre(Position{20, 38}));
  EXPECT_NEAR(bench_.output<double>("X"), 20.0, 1e-9);
  EXPECT_NEAR(bench_.output<double>("Y"), 38.0, 1e-9);
  EXPECT_GT(bench_.output<double>("Area"), 100.0);
  EXPECT_TRUE(bench_.output<bool>("Seen"));
}

TEST_F(VisionTest, TellsOnceForEachImageInWhichTheBallIs) {
  const auto& positions = bench_.record<std::int32_t, std::int32_t>("ObjectPositionEvent");
  make_recognise();
  show_ball(20, 10);
  show_floor();
  show_ball(22, 10);
  show_ball(22, 12);
  bench_.run_cycles(3);
  EXPECT_THAT(positions, ElementsAre(Position{20, 38}, Position{22, 38}, Position{22, 36}));
}

TEST_F(VisionTest, WithoutTheBallThePositionStaysUnwrittenSoThatItAges) {
  make_recognise();
  show_ball(20, 10);
  const auto writes = bench_.writes("X");
  show_floor();
  EXPECT_EQ(bench_.writes("X"), writes);
  EXPECT_FALSE(bench_.output<bool>("Seen"));
}

TEST_F(VisionTest, SeesTheColourThatSetThresholdSays) {
  const auto& positions = bench_.record<std::int32_t, std::int32_t>("ObjectPositionEvent");
  make_recognise();
  show_ball(20, 10, kBlue);
  EXPECT_THAT(positions, IsEmpty());
  EXPECT_EQ(set_threshold(0, 0, 255), Vision::kDone);
  show_ball(20, 10, kBlue);
  EXPECT_THAT(positions, ElementsAre(Position{20, 38}));
  show_ball(20, 10, kRed);
  EXPECT_EQ(positions.size(), 1u);
}

TEST_F(VisionTest, RefusesWhatIsNoColour) {
  EXPECT_EQ(set_threshold(256, 0, 0), Vision::kNoColour);
  EXPECT_EQ(set_threshold(0, 0, 4000000000u), Vision::kNoColour);
  EXPECT_EQ(set_threshold(90, 90, 90), Vision::kNoColour) << "a grey has no hue";
  EXPECT_EQ(bench_.get<int>("Red"), 255) << "as it was";
  EXPECT_EQ(set_threshold(250, 120, 10), Vision::kDone);
  EXPECT_EQ(bench_.get<int>("Green"), 120);
}

TEST_F(VisionTest, PropertiesThatAreSetWhileItIsStoppedCountFromTheNextStart) {
  const auto& positions = bench_.record<std::int32_t, std::int32_t>("ObjectPositionEvent");
  bench_.stop();
  bench_.set("MinArea", 1000);
  start();
  make_recognise();
  show_ball(20, 10);
  EXPECT_THAT(positions, IsEmpty());
}

// --- figure 6 ------------------------------------------------------------------------------------

TEST_F(VisionTest, BeginsOffAndSeesNothing) {
  const auto& positions = bench_.record<std::int32_t, std::int32_t>("ObjectPositionEvent");
  show_ball(20, 10);
  EXPECT_EQ(is_in(), "Off");
  EXPECT_THAT(positions, IsEmpty());
}

TEST_F(VisionTest, StartBeforeInitializeIsRefusedWithWhatToDo) {
  const auto refused = bench_.call("start");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error(), HasSubstr("it is not initialized: call initialize first"));
  EXPECT_EQ(is_in(), "Off");
}

TEST_F(VisionTest, InitializeMakesItReady) {
  make_ready();
  EXPECT_EQ(is_in(), "Ready");
  show_ball(20, 10);
  EXPECT_EQ(is_in(), "Ready") << "it was not started";
}

TEST_F(VisionTest, ItMayBeInitializedBeforeTheFirstImage) {
  EXPECT_EQ(initialize(), Vision::kDone);
  EXPECT_EQ(is_in(), "Ready");
}

TEST_F(VisionTest, InitializeSaysThatItDoesNotRun) {
  bench_.stop();
  EXPECT_EQ(initialize(), Vision::kNotRunning);
}

TEST_F(VisionTest, StartMakesItSearchAndTheBallTrack) {
  make_recognise();
  EXPECT_EQ(is_in(), "Recognising/Searching");
  show_ball(20, 10);
  EXPECT_EQ(is_in(), "Recognising/Tracking");
  show_ball(24, 10);
  EXPECT_EQ(is_in(), "Recognising/Tracking");
  show_floor();
  EXPECT_EQ(is_in(), "Recognising/Searching");
}

TEST_F(VisionTest, StartIsDoneAtOnceAndMayComeTwice) {
  make_ready();
  auto first = bench_.send("start");
  EXPECT_EQ(first.stage(), component::CommandStage::kDone);
  show_ball(20, 10);
  auto second = bench_.send("start");
  EXPECT_EQ(second.stage(), component::CommandStage::kDone);
  EXPECT_EQ(is_in(), "Recognising/Tracking");
}

TEST_F(VisionTest, StopMakesItReadyAgain) {
  const auto& positions = bench_.record<std::int32_t, std::int32_t>("ObjectPositionEvent");
  make_recognise();
  show_ball(20, 10);
  ASSERT_TRUE(bench_.call("stop"));
  EXPECT_EQ(is_in(), "Ready");
  EXPECT_FALSE(bench_.output<bool>("Seen"));
  show_ball(30, 10);
  EXPECT_EQ(positions.size(), 1u);
  ASSERT_TRUE(bench_.call("start"));
  EXPECT_EQ(is_in(), "Recognising/Searching");
}

TEST_F(VisionTest, StopChangesNothingWhereNothingIsRecognised) {
  ASSERT_TRUE(bench_.call("stop"));
  EXPECT_EQ(is_in(), "Off");
  make_ready();
  ASSERT_TRUE(bench_.call("stop"));
  EXPECT_EQ(is_in(), "Ready");
}

TEST_F(VisionTest, InitializeEndsARecognition) {
  make_recognise();
  EXPECT_EQ(initialize(), Vision::kDone);
  EXPECT_EQ(is_in(), "Ready");
}

// --- the camera ----------------------------------------------------------------------------------

TEST_F(VisionTest, ACameraThatSendsNothingFailsTheRecognition) {
  const auto& failures = bench_.record<base::FixedText<31>, base::FixedText<127>>("Failed");
  make_recognise();
  show_ball(20, 10);
  bench_.run_cycles(10);
  EXPECT_EQ(is_in(), "Recognising/Tracking") << "500 ms without an image are allowed";
  bench_.run_cycles();
  EXPECT_EQ(is_in(), "Failed");
  EXPECT_FALSE(bench_.output<bool>("Seen"));
  EXPECT_THAT(failures,
              ElementsAre(Failure{"start", "no image comes from the camera (ImageTimeout)"}));
  EXPECT_THAT(bench_.log(), ::testing::Contains(HasSubstr("start cannot go on: no image comes")));
  bench_.run_cycles(20);
  EXPECT_EQ(failures.size(), 1u) << "it is told once";
}

TEST_F(VisionTest, ACameraThatIsGoneWhileItIsReadyIsToldToo) {
  const auto& failures = bench_.record<base::FixedText<31>, base::FixedText<127>>("Failed");
  make_ready();
  bench_.run_cycles(11);
  EXPECT_EQ(is_in(), "Failed");
  EXPECT_THAT(failures,
              ElementsAre(Failure{"initialize", "no image comes from the camera (ImageTimeout)"}));
}

TEST_F(VisionTest, InitializeSaysThatTheCameraIsGone) {
  bench_.run_cycles(11);
  EXPECT_EQ(is_in(), "Off") << "nobody asked for it yet";
  EXPECT_EQ(initialize(), Vision::kCameraGone);
  EXPECT_EQ(is_in(), "Failed");
  EXPECT_EQ(initialize(), Vision::kCameraGone);
}

TEST_F(VisionTest, OnlyInitializeLeadsOutOfFailed) {
  make_recognise();
  bench_.run_cycles(11);
  ASSERT_EQ(is_in(), "Failed");
  show_ball(20, 10);
  EXPECT_EQ(is_in(), "Failed") << "the camera is back, and nobody asked for it";
  const auto refused = bench_.call("start");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error(), HasSubstr("call initialize when it sends images again"));
  ASSERT_TRUE(bench_.call("stop"));
  EXPECT_EQ(is_in(), "Failed");
  EXPECT_EQ(initialize(), Vision::kDone);
  EXPECT_EQ(is_in(), "Ready");
}

TEST_F(VisionTest, AnImageThatEqualsTheOneBeforeGivesNoPositionAndIsCounted) {
  const auto& positions = bench_.record<std::int32_t, std::int32_t>("ObjectPositionEvent");
  make_recognise();
  show_ball(20, 10);
  const auto writes = bench_.writes("X");
  images_ -= 1;
  show_ball(20, 10);
  EXPECT_EQ(positions.size(), 1u);
  EXPECT_EQ(bench_.writes("X"), writes);
  EXPECT_EQ(bench_.output<int>("EqualImages"), 1);
  show_ball(20, 10);
  EXPECT_EQ(positions.size(), 2u) << "it differs again";
  EXPECT_EQ(bench_.output<int>("EqualImages"), 1);
}

TEST_F(VisionTest, AFrozenCameraFailsTheRecognition) {
  const auto& failures = bench_.record<base::FixedText<31>, base::FixedText<127>>("Failed");
  make_recognise();
  const vision::Image frozen = floor();
  for (int i = 0; i < 10; ++i) show(frozen);
  EXPECT_EQ(is_in(), "Recognising/Searching") << "9 equal the one before";
  show(frozen);
  EXPECT_EQ(is_in(), "Failed");
  EXPECT_EQ(bench_.output<int>("EqualImages"), 10);
  EXPECT_THAT(failures,
              ElementsAre(Failure{
                  "start", "the camera sends the same image again and again (MaxEqualImages)"}));
  EXPECT_EQ(initialize(), Vision::kCameraGone) << "it is frozen still";
  show_floor();
  EXPECT_EQ(initialize(), Vision::kDone);
}

TEST_F(VisionTest, EqualImagesCountInARow) {
  make_recognise();
  for (int i = 0; i < 4; ++i) {
    const vision::Image frozen = floor();
    for (int k = 0; k < 8; ++k) show(frozen);
  }
  EXPECT_EQ(is_in(), "Recognising/Searching");
  EXPECT_EQ(bench_.output<int>("EqualImages"), 4 * 7);
}

TEST_F(VisionTest, StartsAnewAfterAStopOfTheComponent) {
  make_recognise();
  bench_.run_cycles(11);
  ASSERT_EQ(is_in(), "Failed");
  bench_.stop();
  start();
  EXPECT_EQ(is_in(), "Off");
  EXPECT_EQ(bench_.output<int>("EqualImages"), 0);
  EXPECT_EQ(initialize(), Vision::kDone);
}

// --- real time -----------------------------------------------------------------------------------

TEST_F(VisionTest, NothingIsAllocatedForAnImageOrAFailure) {
  make_recognise();
  show_floor();
  const vision::Image image = ball(20, 10);
  const testing::RealtimeGuard guard;
  show(image);
  const bool seen = bench_.output<bool>("Seen");
  show(image);
  bench_.run_cycles(12);
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
  EXPECT_TRUE(seen);
  EXPECT_EQ(is_in(), "Failed");
}

}  // namespace
}  // namespace armature::rover
