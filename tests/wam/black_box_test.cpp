// SPDX-License-Identifier: Apache-2.0
// What is kept of the arm's last cycles when it goes out of service.
#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/wam/arm.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

std::vector<base::Time> times_of(const exec::BlackBoxReport& report, const std::string& channel) {
  std::vector<base::Time> times;
  for (const auto& sample : report.samples) {
    if (report.channels[sample.channel].name == channel) times.push_back(sample.time);
  }
  return times;
}

/// In real time of every cycle; simulated time is not to spend itself on it, so there a third.
TEST(WamBlackBox, HasStatesAndCommandsOfTheLastSecondAndTheFault) {
  std::vector<exec::BlackBoxReport> reports;
  Arm arm("npid7.yaml", {}, [&](exec::ApplicationOptions& options) {
    options.black_box.write = [&](const exec::BlackBoxReport& report) {
      reports.push_back(report);
      return std::string();
    };
  });
  arm.start_armed();
  ASSERT_EQ(arm.move_to({0.6, -1.0, 0.4, 2.0, -0.5, 0.4, 0.5}, 5.0), "");
  arm.run_for(2500ms);
  arm.emulator().board().fail(Monitor::kVelocity);
  arm.run_for(1s);
  ASSERT_FALSE(reports.empty());
  EXPECT_EQ(reports[0].component, "WAM");
  EXPECT_THAT(reports[0].reason, HasSubstr("velocity fault"));
  for (const char* channel : {"WAM.jointsDataPort", "Actuator.Torque", "BridgeRef.reference"}) {
    const auto times = times_of(reports[0], channel);
    ASSERT_FALSE(times.empty()) << channel;
    EXPECT_LE(times.front(), reports[0].time - 1s) << channel;
    EXPECT_TRUE(std::ranges::find(times, reports[0].time) != times.end()) << channel;
    for (std::size_t i = 1; i < times.size(); ++i) {
      EXPECT_LE(times[i] - times[i - 1], 3 * Arm::kPeriod);
    }
  }
}

}  // namespace
}  // namespace armature::wam
