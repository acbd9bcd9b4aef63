// SPDX-License-Identifier: Apache-2.0
#include "tests/wam/campaign_table.hpp"

#include <cstdio>
#include <iterator>

#include <gtest/gtest.h>

namespace armature::wam {
namespace {

constexpr const char* kCampaign = "WAM";

/// For people who have asked for many runs.
class Table : public ::testing::Environment {
 public:
  void TearDown() override {
    if (!campaign::wants_table(kCampaign)) return;
    std::printf("%-32s %5s %9s %9s %10s %9s %6s  %s\n", "fault", "runs", "step", "torque", "moved",
                "sinking", "kept", "hardware afterwards");
    for (const auto& [name, all] : campaign_table()) print(name, all);
  }

 private:
  static void print(const std::string& name, const CampaignFigures& all) {
    const std::string kept = all.cycles_kept ? std::to_string(*all.cycles_kept) : "-";
    std::printf("%-32s %5d %9.3f %9.3f %10.5f %9.2f %6s  %s\n", name.c_str(), all.runs, all.step,
                all.torque, all.moved, all.sinking, kept.c_str(), campaign::states_of(all).c_str());
    campaign::print_failed(name, all);
  }
};
const auto* const kTable = ::testing::AddGlobalTestEnvironment(new Table);

}  // namespace

std::map<std::string, CampaignFigures>& campaign_table() {
  static std::map<std::string, CampaignFigures> all;
  return all;
}

const char* campaign_file(int run, bool with_wrist) {
  static constexpr const char* kFiles[] = {"npid4.yaml", "npid7.yaml", "computed_torque4.yaml",
                                           "computed_torque7.yaml"};
  const auto turn = static_cast<std::size_t>(run);
  return kFiles[(with_wrist ? 2 * turn + 1 : turn) % std::size(kFiles)];
}

void make_runs(const std::string& name, const std::function<void(int)>& run) {
  campaign::make_runs(kCampaign, name, campaign_table()[name], run);
}

}  // namespace armature::wam
