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

TEST(WamBlackBox, HasTheLastFiveHundredCyclesOfStatesAndCommandsWithTheFault) {
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
    auto times = times_of(reports[0], channel);
    std::erase_if(times, [&](base::Time time) { return time > reports[0].time; });
    ASSERT_GE(times.size(), 500u) << channel;
    for (std::size_t i = times.size() - 500; i < times.size(); ++i) {
      ASSERT_EQ(times[i] - times[i - 1], Arm::kPeriod) << channel;
    }
  }
}

}  // namespace
}  // namespace armature::wam
