// SPDX-License-Identifier: Apache-2.0
// A complete session, from E-stop to idle, every frame as candump would log it, beside
// testdata/sessions/NAME.log. UPDATE_EXPECTED=1 in the environment writes the files, to be read
// before they are committed.
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "armature/can/candump.hpp"
#include "robots/wam/driver/test_hosted_bench.hpp"

namespace armature::wam {
namespace {

constexpr base::Time kEnd{std::chrono::seconds(10)};

class WamSession : public ::testing::TestWithParam<std::size_t> {
 protected:
  std::string file() const {
    return ROBOT_FOLDER "/testdata/sessions/wam" + std::to_string(GetParam()) + ".log";
  }
};

/// The operator's part and the host's: start-up, some cycles, activation, ten cycles with torques,
/// idle.
std::string session_of(Hosted& bench) {
  bench.board().reset();
  bench.board().shift_idle();
  EXPECT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  EXPECT_EQ(bench.zero(), WamProgress::kDone) << bench.said();
  bench.driver = WamDriver::make(bench.host, bench.startup->record(), {}).value();
  bench.driver->start(bench.now());
  bench.run(2);
  bench.board().shift_activate();
  while (!bench.driver->active() && bench.now() < kEnd) bench.run(1);
  EXPECT_TRUE(bench.driver->active());
  for (std::size_t motor = 0; motor < bench.emulator->motors(); ++motor) {
    bench.torques[motor] = 0.001 * (static_cast<double>(motor) - 2.5);
  }
  bench.run(10);
  EXPECT_EQ(bench.driver->fault(), WamFault::kNone);
  bench.board().shift_idle();
  while (bench.driver->active() && bench.now() < kEnd) bench.run(1);
  EXPECT_EQ(bench.driver->board_mode(), BoardMode::kIdle);
  bench.run(2);
  can::LogWriter log("can0");
  for (const can::WireEvent& event : bench.log) log.add(event.end, event.frame);
  return log.text();
}

TEST_P(WamSession, IsThisFrameByFrame) {
  Hosted bench(GetParam());
  const std::string logged = session_of(bench);
  if (std::getenv("UPDATE_EXPECTED") != nullptr) std::ofstream(file()) << logged;
  std::stringstream expected;
  expected << std::ifstream(file()).rdbuf();
  EXPECT_EQ(logged, expected.str()) << file();
}

TEST_P(WamSession, TheFileIsALogOfCandump) {
  std::stringstream text;
  text << std::ifstream(file()).rdbuf();
  base::Diagnostics diagnostics;
  const auto entries = can::parse_candump(text.str(), file(), diagnostics);
  EXPECT_TRUE(diagnostics.empty()) << diagnostics.to_text();
  EXPECT_GT(entries.size(), 250u);
  EXPECT_EQ(can::to_text(entries), text.str());
}

INSTANTIATE_TEST_SUITE_P(Arms, WamSession, ::testing::Values(4, 7), [](const auto& tested) {
  return "Of" + std::to_string(tested.param) + "Joints";
});

}  // namespace
}  // namespace armature::wam
