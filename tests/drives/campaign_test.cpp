// SPDX-License-Identifier: Apache-2.0
// Everything that may break in an arm of seven drives by CiA 402, at random times of a motion, in
// each of the modes CST, CSV and CSP, in simulated time. Whatever it is: drives are told nothing
// beyond the limits, the arm ends as it was promised, no drive is enabled before it is armed again,
// and then it does what it is told.
//
//     CIA402_CAMPAIGN_RUNS=1000 drives_campaign    as many runs of each, and a table of them
//     CIA402_CAMPAIGN_RUN=16 drives_campaign       that run of each, such as one that failed
#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "tests/campaign/runs.hpp"
#include "tests/drives/campaign_arm.hpp"
#include "tests/drives/campaign_faults.hpp"
#include "tests/drives/campaign_judges.hpp"

namespace armature::cia402 {
namespace {

using namespace std::chrono_literals;

constexpr const char* kCampaign = "CIA402";
/// The promised stop is over then, and the arm at rest.
constexpr base::Duration kAtRestWithin = 600ms;
constexpr double kAtRest = 0.01;  // [rad/s]
/// An axis may be faster than its target by what its drive overshoots.
constexpr double kMostSpeed = 1.25;
/// One that takes torques has all of them until its limiter has seen that it is too fast, and the
/// answer acts: four cycles of 2 ms, 20 Nm, 0.25 kg m^2, 2 rad/s.
constexpr double kMostSpeedByTorque = 1.0 + 4 * 0.002 * 20.0 / 0.25 / 2.0;

/// What all runs of a breakage in a mode had at most, as shares of what is allowed.
struct Figures : campaign::Account {
  double target = 0.0;
  double step = 0.0;
  double speed = 0.0;
  double moved = 0.0;  ///< [rad], unarmed
  int enabled = 0;     ///< cycles, unarmed
};
std::map<std::string, Figures>& table() {
  static std::map<std::string, Figures> all;
  return all;
}

/// For people who have asked for many runs.
class Table : public ::testing::Environment {
 public:
  void TearDown() override {
    if (!campaign::wants_table(kCampaign)) return;
    std::printf("%-40s %5s %7s %7s %7s %10s %8s  %s\n", "fault", "runs", "target", "step", "speed",
                "moved", "enabled", "afterwards");
    for (const auto& [name, all] : table()) {
      std::printf("%-40s %5d %7.3f %7.3f %7.3f %10.5f %8d  %s\n", name.c_str(), all.runs,
                  all.target, all.step, all.speed, all.moved, all.enabled,
                  campaign::states_of(all).c_str());
      campaign::print_failed(name, all);
    }
  }
};
const auto* const kTable = ::testing::AddGlobalTestEnvironment(new Table);

/// A run of the arm in which something breaks.
class Run {
 public:
  Run(const Breakage& breakage, const std::string& mode, int number)
      : breakage_(breakage),
        random_(static_cast<Random::result_type>(20261126 + number)),
        by_torque_(mode == "torque"),
        arm_(mode) {}

  void begin() {
    ASSERT_NO_FATAL_FAILURE(arm_.start());
    arm_.looks = [this] {
      targets_.look_at(arm_);
      if (stands_) rest_.look_at(arm_);
    };
    stands_ = true;
    arm_.run_for(100ms);
    stands_ = false;
    ASSERT_NO_FATAL_FAILURE(arm_.arm());
    std::uniform_real_distribution<double> some(-1.2, 1.2);
    for (double& angle : target_) angle = some(random_);
    ASSERT_EQ(arm_.move_to(target_, kMotion), "");
    arm_.run_for(std::chrono::milliseconds(300 + random_() % 2200));
  }
  void break_it() { breakage_.happens(arm_, random_); }

  void expect_goes_on() {
    arm_.run_for(3500ms);
    state_ = "armed";
    EXPECT_TRUE(arm_.armed()) << arm_.reasons() << arm_.log;
    EXPECT_LT(largest_apart(arm_.positions(), arm_.target()), 0.02);
    breakage_.ends(arm_);
  }
  /// It brakes smoothly, stays there, and does not go on by itself when the cause is gone.
  void expect_brakes() {
    arm_.run_for(1s);
    const Vector at_rest = arm_.positions();
    arm_.run_for(500ms);
    put_back_into_service();
    arm_.run_for(500ms);
    state_ = "armed";
    EXPECT_TRUE(arm_.armed()) << arm_.reasons() << arm_.log;
    EXPECT_LT(largest_apart(arm_.positions(), at_rest), 0.005);
    expect_moves();
  }
  /// The integral of a PID takes seconds to unwind.
  void expect_rests() {
    arm_.run_for(4s);
    EXPECT_LT(arm_.fastest(), kAtRest);
    if (arm_.armed()) return expect_brakes();
    expect_stops();
    expect_comes_back();
  }
  /// As long as its joint is within its bound, nobody can know that its drive has no power.
  void expect_stops_once_seen() {
    constexpr double kMaxPositionError = 0.0524;  // of examples/12_cia402: 3 degrees
    arm_.run_for(3500ms);
    if (arm_.armed()) {
      EXPECT_LT(largest_apart(arm_.positions(), target_), kMaxPositionError);
      for (double& angle : target_) angle += angle > 0.0 ? -0.3 : 0.3;
      ASSERT_EQ(arm_.move_to(target_, 1.0), "");
    }
    expect_stops();
  }
  void expect_stops() {
    arm_.run_for(kAtRestWithin);
    EXPECT_LT(arm_.fastest(), kAtRest);
    note_reason();
    stands_ = true;
    rest_.forget();
    arm_.run_for(500ms);
  }
  void expect_comes_back() {
    breakage_.ends(arm_);
    put_back_into_service();
    arm_.run_for(400ms);
    EXPECT_FALSE(arm_.armed()) << "nothing arms itself";
    if (breakage_.after == After::kLost) {
      static_cast<void>(arm_.application().begin("Arming", "arm", {}));
      arm_.run_for(1500ms);
      EXPECT_FALSE(arm_.armed()) << "a drive that nobody has prepared";
      EXPECT_TRUE(arm_.application().stop().ok());
      stands_ = false;  // all drives are switched on anew
      ASSERT_NO_FATAL_FAILURE(arm_.start());
      arm_.confirm_positions();
    }
    stands_ = false;
    expect_moves();
  }

  void judge() {
    EXPECT_LE(targets_.largest(), 1.001);
    EXPECT_LE(targets_.largest_step(), 1.05);
    EXPECT_LE(targets_.largest_speed(), by_torque_ ? kMostSpeedByTorque : kMostSpeed);
    EXPECT_LE(rest_.moved(), 0.005);
    EXPECT_EQ(rest_.enabled(), 0);
  }
  void note(Figures& all) const {
    all.target = std::max(all.target, targets_.largest());
    all.step = std::max(all.step, targets_.largest_step());
    all.speed = std::max(all.speed, targets_.largest_speed());
    all.moved = std::max(all.moved, rest_.moved());
    all.enabled = std::max(all.enabled, rest_.enabled());
    all.states.insert(state_);
  }

 private:
  static constexpr double kMotion = 3.0;  // [s]

  /// Why it is out of service, without names and numbers of joints.
  void note_reason() {
    const std::string reasons = arm_.reasons();
    state_ = reasons.empty() ? "disarmed" : "";
    for (const std::string& said : breakage_.said) {
      if (reasons.find(said) != std::string::npos) state_ = said;
    }
    EXPECT_NE(state_, "") << reasons;
    EXPECT_TRUE(breakage_.said.empty() || !reasons.empty()) << arm_.log;
    if (state_.empty()) state_ = reasons.substr(0, reasons.find_first_of("\n"));
  }
  /// What an operator does when the cause is gone.
  void put_back_into_service() {
    for (int round = 0; round < 3; ++round) {
      for (int node = 1; node <= static_cast<int>(CampaignArm::kJoints); ++node) {
        // Refused as long as the host itself is out of service.
        static_cast<void>(arm_.call("Bus", "resetDrive", {types::Value::of(node)}));
      }
      arm_.run_for(20ms);
      arm_.reset_and_start_everything();
      arm_.run_for(20ms);
    }
  }
  void expect_moves() {
    const Vector rest = arm_.positions();
    if (!arm_.armed()) {
      ASSERT_NO_FATAL_FAILURE(arm_.arm()) << arm_.reasons();
      arm_.run_for(200ms);
      EXPECT_LT(largest_apart(arm_.positions(), rest), 0.01) << "arming moves nothing";
    }
    const Vector before = arm_.believed();
    Vector target = before;
    for (double& angle : target) angle = std::clamp(angle, -1.3, 1.3);
    target[0] += target[0] > 0.0 ? -0.2 : 0.2;
    ASSERT_EQ(arm_.move_to(target, 1.0), "") << arm_.reasons() << arm_.log;
    arm_.run_for(1500ms);
    EXPECT_LT(largest_apart(arm_.believed(), target), 0.02) << arm_.reasons() << arm_.log;
    EXPECT_TRUE(arm_.armed()) << arm_.reasons();
  }

  const Breakage& breakage_;
  Random random_;
  const bool by_torque_;
  CampaignArm arm_;
  TargetWatch targets_;
  RestWatch rest_;
  bool stands_ = false;  ///< it is not armed and has come to rest
  Vector target_ = Vector(CampaignArm::kJoints);
  std::string state_;
};

void run_once(const Breakage& breakage, const std::string& mode, int number, Figures& figures) {
  Run run(breakage, mode, number);
  ASSERT_NO_FATAL_FAILURE(run.begin());
  ASSERT_NO_FATAL_FAILURE(run.break_it());
  switch (breakage.after) {
    case After::kGoesOn:
      run.expect_goes_on();
      break;
    case After::kBrakes:
      run.expect_brakes();
      break;
    case After::kRests:
      run.expect_rests();
      break;
    case After::kStoppedOnceSeen:
      ASSERT_NO_FATAL_FAILURE(run.expect_stops_once_seen());
      run.expect_comes_back();
      break;
    default:
      run.expect_stops();
      run.expect_comes_back();
  }
  run.judge();
  run.note(figures);
}

class Cia402Campaign : public ::testing::TestWithParam<std::tuple<Breakage, const char*>> {};

TEST_P(Cia402Campaign, AtAnyTimeItEndsAsPromised) {
  const auto& [breakage, mode] = GetParam();
  const std::string name = std::string(breakage.name) + ", " + mode;
  Figures& figures = table()[name];
  campaign::make_runs(kCampaign, name, figures,
                      [&](int number) { run_once(breakage, mode, number, figures); });
}

INSTANTIATE_TEST_SUITE_P(Everything, Cia402Campaign,
                         ::testing::Combine(::testing::ValuesIn(breakages()),
                                            ::testing::Values("torque", "velocity", "position")),
                         [](const auto& tested) {
                           return std::string(std::get<0>(tested.param).name) + "_" +
                                  std::get<1>(tested.param);
                         });

}  // namespace
}  // namespace armature::cia402
