// SPDX-License-Identifier: Apache-2.0
// Taught motions under the real-time guard: every function that says it is real-time.
#include <chrono>
#include <memory>
#include <string_view>
#include <vector>

#include "armature/base/fixed_text.hpp"
#include "armature/control/taught/taught_motion.hpp"
#include "armature/control/taught/taught_player.hpp"
#include "armature/control/taught/timed_path.hpp"
#include "armature/controllers/teach/axes_generator_taught.hpp"
#include "armature/testing/harness.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::control {
namespace {

using namespace std::chrono_literals;
using Vector = std::vector<double>;

/// Seven axes that swing, 100 control points.
Vector a_swing() {
  Vector points;
  for (int i = 0; i < 100; ++i) points.insert(points.end(), 7, 0.01 * (i < 50 ? i : 100 - i));
  return points;
}

TEST(RealtimeFunctions, TimedPath) {
  TimedPath path(std::vector<PathLimits>(7, {2.0, 4.0}), 100);
  const Vector points = a_swing();
  SplineWeights weights;
  expect_realtime("SplineWeights::at", [&] { weights = SplineWeights::at(0.5); });
  EXPECT_NEAR(weights.position[1], 23.0 / 48.0, 1e-12);
  double within = 0.0;
  expect_realtime("control::taught_hull", [&] { within = taught_hull(points, 7, 0, 0)[0]; });
  EXPECT_NEAR(within, 0.01, 1e-12);
  expect_realtime("TimedPath::load", [&] { path.load(points, 1.0); });
  expect_realtime("TimedPath::plan", [&] { path.plan(nullptr); });
  ASSERT_TRUE(path.planned());
  expect_realtime("TimedPath::begin", [&] { path.begin(); });
  expect_realtime("TimedPath::step", [&] { path.step(0.01); });
  EXPECT_GT(path.positions()[0], 0.05);
}

TEST(RealtimeFunctions, TaughtPlayer) {
  auto player =
      TaughtPlayer::make({std::vector(7, OnlineTrajectory::Axis{2, 4, 40, -1, 1}), 10.0}).value();
  const Vector points = a_swing();
  const Vector zero(7, 0.1);
  const Vector begin(7, 0.01);
  bool accepted = true;
  expect_realtime("TaughtPlayer::check",
                  [&] { accepted = accepted && player.check(points, 1.0).accepted(); });
  expect_realtime("TaughtPlayer::play", [&] {
    accepted = accepted && player.play({zero}, points, 1.0, nullptr).accepted();
  });
  expect_realtime("TaughtPlayer::play_from_here", [&] {
    accepted = accepted && player.play_from_here({begin}, points, 1.0, nullptr).accepted();
  });
  EXPECT_TRUE(accepted);
  expect_realtime("TaughtPlayer::step", [&] { player.step(10ms); });
  EXPECT_TRUE(player.on_path());
  expect_realtime("TaughtPlayer::stop", [&] { player.stop(); });
  std::string_view text;
  expect_realtime("control::to_text", [&] { text = to_text(player.check(points, 99.0).refusal); });
  EXPECT_EQ(text, "the speed must be from 0.01 to 10");
}

}  // namespace
}  // namespace armature::control

namespace armature::controllers {
namespace {

TEST(RealtimeComponents, AxesGeneratorTaught) {
  testing::Harness generator(std::make_unique<AxesGeneratorTaught>("Generator"),
                             std::chrono::milliseconds(10));
  generator.set("num_axes", 7);
  for (const char* name : {"max_vel", "max_acc", "upper"}) generator.set(name, "[1.0]");
  generator.set("lower", "[-1.0]");
  ASSERT_TRUE(generator.start()) << generator.reason();
  const control::Vector zero(7, 0.0);
  const control::Vector points = control::a_swing();
  generator.write("nAxesSensorPosition", zero);
  int plays = 0;
  expect_realtime_on_bench("AxesGeneratorTaught", [&] {
    generator.write("nAxesSensorPosition", zero);
    generator.run_cycles();
    auto motion = generator.send("playPath", points, 1.0);
    if (motion.stage() == component::CommandStage::kAccepted) ++plays;
    EXPECT_FALSE(generator.call("moveTo", zero, 0.0));
    generator.write("nAxesSensorPosition", zero);
    generator.run_cycles(9);
    EXPECT_FALSE(generator.call("jogPath", points, 1.0));
    motion.cancel();
    generator.write("nAxesSensorPosition", zero);
    generator.run_cycles(3);
    EXPECT_TRUE(generator.call("resetPosition"));
    generator.raise("Switched", base::FixedText<63>("weightless"));
    generator.run_cycles(2);
    generator.raise("Switched", base::FixedText<63>("npid"));
    generator.raise("Stop");
    generator.raise("Settle");
  });
  EXPECT_EQ(plays, 100);
}

TEST(RealtimeComponents, AxesGeneratorTaughtJogs) {
  testing::Harness generator(std::make_unique<AxesGeneratorTaught>("Generator"),
                             std::chrono::milliseconds(10));
  generator.set("num_axes", 7);
  for (const char* name : {"max_vel", "max_acc", "upper"}) generator.set(name, "[1.0]");
  generator.set("lower", "[-1.0]");
  ASSERT_TRUE(generator.start()) << generator.reason();
  const control::Vector begin(7, 0.01);
  const control::Vector points = control::a_swing();
  int jogs = 0;
  int plays = 0;
  expect_realtime_on_bench("AxesGeneratorTaught jogs", [&] {
    generator.write("nAxesSensorPosition", begin);
    generator.run_cycles();
    generator.raise("Settle");
    auto jog = generator.send("jogPath", points, 1.0);
    if (jog.stage() == component::CommandStage::kAccepted) ++jogs;
    for (int i = 0; i < 10; ++i) {
      EXPECT_TRUE(generator.call<bool>("keepJoggingPath").value());
      generator.write("nAxesSensorPosition", begin);
      generator.run_cycles();
    }
    generator.raise("Settle");
    auto motion = generator.send("playFromHere", points, 1.0);
    if (motion.stage() == component::CommandStage::kAccepted) ++plays;
    generator.run_cycles(5);
    generator.raise("Settle");
  });
  EXPECT_EQ(jogs, 100);
  EXPECT_EQ(plays, 100);
}

}  // namespace
}  // namespace armature::controllers
