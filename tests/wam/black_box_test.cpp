// SPDX-License-Identifier: Apache-2.0
// What is kept of the arm's last cycles when it goes out of service.
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/wam/arm.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

constexpr std::size_t kCycles = 500;

using Times = std::vector<base::Time>;

/// Of one channel, up to the fault.
Times times_of(const exec::BlackBoxReport& report, const std::string& channel) {
  Times times;
  for (const auto& sample : report.samples) {
    const bool named = report.channels[sample.channel].name == channel;
    if (named && sample.time <= report.time) times.push_back(sample.time);
  }
  return times;
}

/// As it was `before` cycles before the fault.
template <typename T>
T value_of(const exec::BlackBoxReport& report, const std::string& channel, int before) {
  T value{};
  for (const auto& sample : report.samples) {
    const auto& of = report.channels[sample.channel];
    if (of.name != channel || sample.time != report.time - before * Arm::kPeriod) continue;
    types::Value decoded = of.shape;
    EXPECT_TRUE(
        types::decode(decoded.type(), sample.value.data(), sample.value.size(), decoded.data()));
    value = *static_cast<const T*>(decoded.data());
  }
  return value;
}

class WamBlackBox : public ::testing::TestWithParam<const char*> {
 protected:
  /// The board finds a fault in a motion.
  WamBlackBox()
      : arm(GetParam(), {}, [this](exec::ApplicationOptions& options) {
          options.black_box.write = [this](const exec::BlackBoxReport& report) {
            reports.push_back(report);
            return std::string();
          };
        }) {
    arm.start_armed();
    Vector target{0.6, -1.0, 0.4, 2.0, -0.5, 0.4, 0.5};
    target.resize(arm.joints());
    EXPECT_EQ(arm.move_to(target, 5.0), "");
    arm.run_for(2500ms);
    arm.emulator().board().fail(Monitor::kVelocity);
    arm.run_for(1s);
  }

  std::vector<exec::BlackBoxReport> reports;
  Arm arm;
};
INSTANTIATE_TEST_SUITE_P(Of, WamBlackBox,
                         ::testing::Values("npid4.yaml", "npid7.yaml", "computed_torque4.yaml",
                                           "computed_torque7.yaml", "controller_wam7.yaml",
                                           "modes7.yaml"),
                         [](const auto& tested) {
                           const std::string file = tested.param;
                           return file.substr(0, file.find('.'));
                         });

/// In simulated time, which is to spend less on it, and so in real time.
TEST_P(WamBlackBox, HasStatesAndCommandsOfEachOfTheLast500CyclesAndTheFault) {
  ASSERT_FALSE(reports.empty());
  const exec::BlackBoxReport& report = reports[0];
  EXPECT_EQ(report.component, "WAM");
  EXPECT_THAT(report.reason, HasSubstr("velocity fault"));
  EXPECT_EQ(report.incomplete, "");
  for (const char* channel : {"WAM.jointsDataPort", "WAM.sentTorquePort", "WAM.safetyStatePort",
                              "WAM.Armed1", "Actuator.Torque", "BridgeRef.reference"}) {
    const Times times = times_of(report, channel);
    ASSERT_GE(times.size(), kCycles) << channel;
    for (std::size_t i = 1; i <= kCycles; ++i) {
      ASSERT_EQ(times[times.size() - i], report.time - (i - 1) * Arm::kPeriod) << channel;
    }
  }
}

TEST_P(WamBlackBox, TellsTheTorquesThatWereSentAndTheStateOfTheBoard) {
  ASSERT_FALSE(reports.empty());
  const exec::BlackBoxReport& report = reports[0];
  const auto sent = [&](int before) {
    return value_of<Vector>(report, "WAM.sentTorquePort", before);
  };
  EXPECT_EQ(sent(0), Vector(arm.joints(), 0.0)) << "at the fault";
  EXPECT_GT(std::abs(sent(300)[1]), 5.0) << "of the weight";
  const auto data = value_of<Vector>(report, "WAM.jointsDataPort", 299);
  EXPECT_EQ(Vector(data.end() - static_cast<std::ptrdiff_t>(arm.joints()), data.end()), sent(300))
      << "a reading tells the torques under which it came about";
  EXPECT_EQ(value_of<SafetyState>(report, "WAM.safetyStatePort", 300), SafetyState::kActivated);
  EXPECT_EQ(value_of<SafetyState>(report, "WAM.safetyStatePort", 0), SafetyState::kIdle);
}

}  // namespace
}  // namespace armature::wam
