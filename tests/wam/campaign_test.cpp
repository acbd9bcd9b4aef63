// SPDX-License-Identifier: Apache-2.0
// Everything that may break in the arm, at random times of a motion, many times over, in simulated
// time. Whatever it is: torques on the bus stay within the pucks' and do not jump, the arm ends as
// it was promised, does not move before it is armed again, and then does what it is told.
//
//     WAM_CAMPAIGN_RUNS=1000 wam_deployed_campaign    as many runs of each, and a table of them
//     WAM_CAMPAIGN_RUN=16 wam_deployed_campaign       that run of each, such as one that failed
#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "armature/base/seconds.hpp"
#include "armature/record/black_box_file.hpp"
#include "armature/record/mcap_reader.hpp"
#include "tests/wam/campaign_arm.hpp"
#include "tests/wam/campaign_faults.hpp"
#include "tests/wam/campaign_judges.hpp"
#include "tests/wam/campaign_table.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using component::State;
using ::testing::HasSubstr;

/// The promised stop is over then, and the arm at rest.
constexpr base::Duration kAtRestWithin = 600ms;

/// A run of the arm in which something breaks.
class CampaignRun {
 public:
  CampaignRun(const Breakage& breakage, int number)
      : breakage_(breakage),
        random_(static_cast<Random::result_type>(20261122 + number)),
        arm_(campaign_file(number, breakage.of_wrist()),
             [this](const exec::BlackBoxReport& report) {
               reports_.push_back(report);
               return std::string();
             }) {}
  ~CampaignRun() {
    if (!torques_) return;
    arm_.emulator().bus().set_tap({});  // stopping still sends
    note();
  }

  void begin() {
    ASSERT_NO_FATAL_FAILURE(arm_.start_active());
    torques_.emplace(arm_);
    rest_.emplace(arm_);
    arm_.emulator().bus().set_tap(
        [this](const can::WireEvent& event) { torques_->look_at(event); });
    run_for(200ms);
    rest_->forget();
    ASSERT_NO_FATAL_FAILURE(arm_.arm());
    target_ = any_target();
    ASSERT_EQ(arm_.move_to(target_, kMotion), "");
    run_for(std::chrono::milliseconds(700 + random_() % 3100));
  }
  void break_it() {
    broken_at_ = arm_.application().now();
    break_arm(breakage_, arm_, random_);
  }

  void expect_goes_on() {
    run_for(base::from_seconds(kMotion + 0.5));
    state_ = states();
    EXPECT_TRUE(arm_.armed()) << arm_.log;
    EXPECT_LT(largest_apart(arm_.positions(), target_), 0.02);
    breakage_.ends(arm_);
  }
  /// It brakes smoothly, stays there, and does not go on by itself when the cause is gone.
  void expect_brakes() {
    run_for(1s);
    const Vector at_rest = arm_.positions();
    run_for(500ms);
    put_back_into_service();
    run_for(500ms);
    state_ = states();
    EXPECT_TRUE(arm_.armed()) << arm_.log;
    EXPECT_LT(largest_apart(arm_.positions(), at_rest), 0.005);
    expect_moves();
  }
  void expect_ends_as_promised() {
    run_for(kAtRestWithin);
    state_ = states();
    EXPECT_FALSE(arm_.value<bool>("WAM", "Armed1"));
    // Who threw knows nothing any more.
    EXPECT_TRUE(!arm_.armed() || arm_.state("Arming") == State::kException) << arm_.log;
    const bool out = breakage_.after == After::kFault || breakage_.after == After::kLost;
    EXPECT_EQ(arm_.state("WAM"), out ? State::kException : State::kRunning) << arm_.log;
    EXPECT_TRUE(out || !arm_.passes_torques());
    EXPECT_THAT(out ? arm_.reason("WAM") : arm_.log, HasSubstr(breakage_.said));
    if (breakage_.after == After::kIdled) {
      EXPECT_EQ(arm_.safety_state(), "IDLE");
      EXPECT_THAT(arm_.waits_for(), HasSubstr("Shift+Activate"));
    }
    if (breakage_.brakes) run_unarmed_for(500ms);
  }
  void expect_black_box();
  void expect_comes_back() {
    breakage_.ends(arm_);
    if (!breakage_.brakes) run_for(kAtRestWithin);
    run_unarmed_for(200ms);
    if (breakage_.after == After::kLost) {
      ASSERT_NO_FATAL_FAILURE(begin_program_again());
    } else {
      ASSERT_NO_FATAL_FAILURE(let_it_be_active());
    }
    run_unarmed_for(400ms);
    EXPECT_FALSE(arm_.armed()) << "nothing arms itself";
    rest_->forget();
    expect_moves();
  }

  void judge() {
    EXPECT_LE(torques_->largest_step(), 1.0);
    EXPECT_LE(torques_->largest_torque(), 1.0);
    EXPECT_LE(rest_->moved(), 0.005);
    EXPECT_LE(rest_->largest_sinking(), 1.0);
  }

 private:
  static constexpr double kMotion = 4.0;  // [s]

  void run_for(base::Duration duration) {
    for (base::Duration passed{}; passed < duration; passed += CampaignArm::kPeriod) arm_.cycle();
  }
  void run_unarmed_for(base::Duration duration) {
    for (base::Duration passed{}; passed < duration; passed += CampaignArm::kPeriod) {
      arm_.cycle();
      rest_->look_at(arm_);
    }
  }
  Vector any_target() {
    Vector target{0.8, -1.0, 0.5, 2.0, -0.8, 0.6, 0.8};
    std::uniform_real_distribution<double> some(-1.0, 1.0);
    for (double& angle : target) angle *= some(random_);
    target[1] = -1.4 + 0.4 * some(random_);
    target[3] = 2.4 + 0.5 * some(random_);
    target.resize(arm_.joints());
    return target;
  }

  /// What an operator does when the cause is gone.
  void put_back_into_service() {
    for (int round = 0; round < 3; ++round) {
      arm_.reset_and_start_everything();
      run_for(20ms);
    }
  }
  /// An active arm that holds itself is left as it is.
  void let_it_be_active() {
    const bool was_held = arm_.any_puck_drives() && arm_.board().mode() == BoardMode::kActive;
    if (!was_held) arm_.board().shift_idle();
    put_back_into_service();
    run_unarmed_for(200ms);
    if (was_held) return;
    ASSERT_NO_FATAL_FAILURE(do_as_it_says());
  }
  /// Presses the keys that the hardware asks for.
  void do_as_it_says() {
    EXPECT_EQ(arm_.safety_state(), "IDLE") << arm_.log;
    EXPECT_NE(arm_.waits_for(), "");
    for (int i = 0; i < 3 && arm_.safety_state() != "ACTIVATED"; ++i) {
      if (arm_.waits_for().starts_with("Shift+Idle")) arm_.board().shift_idle();
      if (arm_.waits_for().starts_with("Shift+Activate")) arm_.board().shift_activate();
      run_unarmed_for(200ms);
    }
    ASSERT_EQ(arm_.safety_state(), "ACTIVATED") << arm_.log;
    run_unarmed_for(500ms);
  }
  /// The emulated operator puts the arm at home.
  void begin_program_again() {
    if (breakage_.said != std::string("is silent")) {
      ASSERT_TRUE(arm_.application().reset_component("WAM"));
      const auto started = arm_.application().start_component("WAM");
      EXPECT_FALSE(started) << "without its positions";
      EXPECT_THAT(std::string(started.reason()), HasSubstr("put the arm at home"));
    }
    rest_->forget();  // it is carried
    arm_.set("WAM", "emulated_operator", true);
    EXPECT_TRUE(arm_.application().stop().ok());
    arm_.board().reset();
    arm_.link().motors().carry_to(TorqueWatch::numbers_of(arm_).home);
    while (!arm_.link().motors().arrived()) {
      arm_.emulator().advance_to(arm_.emulator().now() + 10ms);
    }
    ASSERT_NO_FATAL_FAILURE(arm_.start_active());
    run_unarmed_for(500ms);
  }
  void expect_moves() {
    const Vector rest = arm_.positions();
    if (!arm_.armed()) {
      ASSERT_NO_FATAL_FAILURE(arm_.arm());
      run_for(200ms);
      EXPECT_LT(largest_apart(arm_.positions(), rest), 0.005) << "arming moves nothing";
    }
    Vector target = arm_.believed();
    const auto lower = arm_.value<Vector>("Generator", "lower");
    const auto upper = arm_.value<Vector>("Generator", "upper");
    for (std::size_t i = 0; i < target.size(); ++i) {
      target[i] = std::clamp(target[i], lower[i] + 0.1, upper[i] - 0.1);
    }
    target[0] += target[0] > 0.0 ? -0.1 : 0.1;
    ASSERT_EQ(arm_.move_to(target, 1.0), "") << arm_.log;
    run_for(1500ms);
    EXPECT_LT(largest_apart(arm_.positions(), target), 0.02) << arm_.log;
    EXPECT_TRUE(arm_.armed()) << arm_.log;
  }

  std::string states() {
    std::string text(component::name_of(arm_.state("WAM")));
    const std::string reason = arm_.reason("WAM");
    if (!reason.empty()) text += " (" + reason.substr(0, reason.find_first_of(":,;")) + ")";
    return text + ", board " + arm_.safety_state() + (arm_.armed() ? ", armed" : "");
  }
  void note() {
    CampaignFigures& all = campaign_table()[breakage_.name];
    all.step = std::max(all.step, torques_->largest_step());
    all.torque = std::max(all.torque, torques_->largest_torque());
    all.moved = std::max(all.moved, rest_->moved());
    all.sinking = std::max(all.sinking, rest_->largest_sinking());
    if (cycles_kept_)
      all.cycles_kept = std::min(all.cycles_kept.value_or(*cycles_kept_), *cycles_kept_);
    all.states.insert(state_);
  }

  const Breakage& breakage_;
  Random random_;
  std::vector<exec::BlackBoxReport> reports_;
  CampaignArm arm_;
  std::optional<TorqueWatch> torques_;
  std::optional<RestWatch> rest_;
  Vector target_;
  base::Time broken_at_{};
  std::string state_;
  std::optional<std::size_t> cycles_kept_;
};

/// How many cycles before `end` follow one another without a gap.
std::size_t cycles_before(base::Time end, const std::set<base::Time>& times) {
  std::size_t cycles = 0;
  auto next = times.upper_bound(end);
  for (base::Time later = end; next != times.begin(); ++cycles) {
    --next;
    if (later - *next > CampaignArm::kPeriod) break;
    later = *next;
  }
  return cycles;
}

/// Several of these programs run at the same time, and files are named by the second.
std::string own_folder() {
  const std::string folder =
      ::testing::TempDir() + "wam_campaign_" + std::to_string(std::random_device{}());
  std::filesystem::create_directories(folder);
  return folder;
}

/// Written and read again, it has states and commands of each of the last 500 cycles, where a
/// component faulted or was stopped.
void CampaignRun::expect_black_box() {
  const bool faulted = breakage_.after == After::kFault || breakage_.after == After::kLost;
  ASSERT_FALSE(faulted && reports_.empty());
  if (reports_.empty()) return;
  const exec::BlackBoxReport& report = reports_.front();
  const std::string folder = own_folder();
  const auto written = record::write_black_box(report, folder);
  ASSERT_TRUE(written) << written.error();
  const auto box = record::load_mcap(written.value());
  std::filesystem::remove_all(folder);
  ASSERT_TRUE(box) << box.error();
  std::map<std::string, std::set<base::Time>> times;
  for (const auto& sample : box.value().samples) {
    times[box.value().channels[sample.channel].name].insert(sample.time);
  }
  for (const char* channel : {"WAM.jointsDataPort", "WAM.sentTorquePort", "WAM.safetyStatePort",
                              "Actuator.Torque", "BridgeRef.reference"}) {
    const std::size_t cycles = cycles_before(report.time, times[channel]);
    EXPECT_GE(cycles, kCyclesKept) << channel;
    cycles_kept_ = std::min(cycles_kept_.value_or(cycles), cycles);
  }
  EXPECT_EQ(report.incomplete, "");
  EXPECT_LE(report.time - broken_at_, 400ms);
}

class WamCampaign : public ::testing::TestWithParam<Breakage> {};
INSTANTIATE_TEST_SUITE_P(Everything, WamCampaign, ::testing::ValuesIn(breakages()),
                         [](const auto& tested) { return std::string(tested.param.name); });

void run_once(const Breakage& breakage, int number) {
  CampaignRun run(breakage, number);
  ASSERT_NO_FATAL_FAILURE(run.begin());
  ASSERT_NO_FATAL_FAILURE(run.break_it());
  switch (breakage.after) {
    case After::kGoesOn:
      run.expect_goes_on();
      break;
    case After::kBrakes:
      run.expect_brakes();
      break;
    default:
      run.expect_ends_as_promised();
      run.expect_black_box();
      ASSERT_NO_FATAL_FAILURE(run.expect_comes_back());
  }
  run.judge();
}

TEST_P(WamCampaign, AtAnyTimeItEndsAsPromised) {
  make_runs(GetParam().name, [](int number) { run_once(GetParam(), number); });
}

}  // namespace
}  // namespace armature::wam
