// SPDX-License-Identifier: Apache-2.0
// The campaign, before the arm moves: what is wrong at a start is told, nothing moves, and put
// right the arm goes on. And nothing that the emulator can break is left out.
#include <set>
#include <sstream>
#include <string>

#include <gmock/gmock.h>

#include "tests/wam/campaign_arm.hpp"
#include "tests/wam/campaign_faults.hpp"
#include "tests/wam/campaign_judges.hpp"
#include "tests/wam/campaign_table.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// Of a puck, while the program does not run.
struct Misfit {
  const char* name = "";
  int told_version = 0;                ///< 0: its own
  std::optional<Property> property{};  ///< that has another value
  std::int32_t value = 0;
  const char* said = "";
  OfPuck puck = OfPuck::kAny;
};
void PrintTo(const Misfit& misfit, std::ostream* out) { *out << misfit.name; }

const Misfit kMisfits[] = {
    {.name = "FirmwareOfWhichNothingIsKnown",
     .told_version = 20,
     .said = "which have different numbers for"},
    {.name = "FirmwareWithOtherNumbers",
     .told_version = 60,
     .said = "which have different numbers for"},
    // What its numbers mean depends on what the properties are there.
    {.name = "FirmwareThatItHasNot", .told_version = 64, .said = "expected"},
    {.name = "TorqueOfAnother",
     .property = Property::kPidx,
     .value = 4,
     .said = "takes torque 4 of its frame (PIDX), expected",
     .puck = OfPuck::kWrist},
    {.name = "GroupOfAnother",
     .property = Property::kGrpb,
     .value = 5,
     .said = "is in groups 0, 5"},
    {.name = "NoTorqueAtAll", .property = Property::kMt, .said = "has MT 0, expected above 0"},
    {.name = "EncoderWithoutCounts", .property = Property::kCts, .said = "has CTS 0, expected"},
};

/// A run of the arm, and the next start, for which something is wrong.
class CampaignStart {
 public:
  CampaignStart(const Misfit& misfit, int number)
      : misfit_(misfit),
        random_(static_cast<Random::result_type>(20261122 + number)),
        arm_(campaign_file(number, misfit.puck == OfPuck::kWrist),
             [](const exec::BlackBoxReport&) { return std::string(); }) {}

  void run() {
    ASSERT_NO_FATAL_FAILURE(arm_.start_active());
    for (auto cycles = random_() % 100; cycles > 0; --cycles) arm_.cycle();
    EXPECT_TRUE(arm_.application().stop().ok());
    puck_ = static_cast<std::size_t>(node_for(misfit_.puck, arm_, random_) - 1);
    const int version = arm_.hardware().driver().arm().pucks[puck_].version;
    const auto kept = misfit_.property ? puck().properties().get(*misfit_.property) : 0;
    set_up(misfit_.told_version > 0 ? misfit_.told_version : version, misfit_.value);
    expect_refused();
    set_up(version, kept);
    arm_.set("WAM", "emulated_operator", true);
    ASSERT_NO_FATAL_FAILURE(arm_.start_active());
    ASSERT_NO_FATAL_FAILURE(arm_.arm());
  }

 private:
  Puck& puck() { return arm_.emulator().puck(puck_); }
  /// By somebody else on the bus; VERS is the firmware's own.
  void set_up(int version, std::int32_t value) {
    puck().tell_version(version);
    if (!misfit_.property) return;
    can::VirtualStation& tool = arm_.emulator().bus().add_station("tool");
    base::Diagnostics diagnostics;
    ASSERT_TRUE(tool.open({}, diagnostics)) << diagnostics.to_text();
    const int number = number_of(PuckKind::kMotor, 175, *misfit_.property).value();
    tool.send(set_frame(to_node(puck().node()), number, value));
    arm_.emulator().advance_to(arm_.emulator().now() + 1ms);
    EXPECT_EQ(puck().properties().get(*misfit_.property), value);
    tool.close();
  }
  void expect_refused() {
    int torques = 0;
    arm_.emulator().bus().set_tap([&](const can::WireEvent& event) {
      const bool to_motors = event.frame.id == 0x401 || event.frame.id == 0x402;
      torques += event.sender == &arm_.link().station() && to_motors && event.frame.size == 8;
    });
    const auto started = arm_.application().start();
    EXPECT_FALSE(started.ok());
    EXPECT_THAT(started.to_text(), HasSubstr(misfit_.said));
    EXPECT_THAT(started.to_text(), HasSubstr("puck " + std::to_string(puck_ + 1)));
    EXPECT_EQ(torques, 0) << "frames to motors that nothing is known of";
    EXPECT_FALSE(arm_.any_puck_drives());
    EXPECT_EQ(arm_.board().mode(), BoardMode::kIdle);
    campaign_table()[misfit_.name].states.insert("refused");
    arm_.emulator().bus().set_tap({});
  }

  const Misfit& misfit_;
  Random random_;
  CampaignArm arm_;
  std::size_t puck_ = 0;
};

class WamCampaignOfStarts : public ::testing::TestWithParam<Misfit> {};
INSTANTIATE_TEST_SUITE_P(Everything, WamCampaignOfStarts, ::testing::ValuesIn(kMisfits),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST_P(WamCampaignOfStarts, IsRefusedWithAReasonAndNothingMoves) {
  make_runs(GetParam().name, [](int number) { CampaignStart(GetParam(), number).run(); });
}

/// Its words without numbers, such as `fault puck N lose`.
std::string fault_in(const std::string& line) {
  std::istringstream stream(line);
  std::string fault;
  for (std::string word; stream >> word;) {
    if (word != "N" && word.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") != std::string::npos) {
      break;
    }
    fault += (fault.empty() ? "" : " ") + word;
  }
  return fault;
}

TEST(WamCampaign, HasEveryFaultOfTheEmulator) {
  std::set<std::string> broken{"fault puck N firmware"};  // by the starts
  for (const Breakage& breakage : breakages()) broken.insert(fault_in(breakage.command));
  std::istringstream commands(emulator_commands());
  int faults = 0;
  for (std::string line; std::getline(commands, line);) {
    const std::string fault = fault_in(line.substr(0, 36));
    if (!fault.starts_with("fault") || fault.ends_with("heals")) continue;
    ++faults;
    EXPECT_TRUE(broken.contains(fault)) << "'" << fault << "' of the emulator breaks nothing here";
  }
  EXPECT_GE(faults, 20);
}

}  // namespace
}  // namespace armature::wam
