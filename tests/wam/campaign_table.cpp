// SPDX-License-Identifier: Apache-2.0
#include "tests/wam/campaign_table.hpp"

#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <optional>

#include <gtest/gtest.h>

namespace armature::wam {
namespace {

constexpr int kRunsInTests = 3;

std::optional<int> number_in_environment(const char* name) {
  const char* text = std::getenv(name);
  if (text == nullptr) return std::nullopt;
  return std::atoi(text);
}

std::vector<int> numbers_of_runs() {
  if (const auto only = number_in_environment("WAM_CAMPAIGN_RUN")) return {*only};
  std::vector<int> all(
      static_cast<std::size_t>(number_in_environment("WAM_CAMPAIGN_RUNS").value_or(kRunsInTests)));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

int failures() {
  return ::testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count();
}

/// For people who have asked for many runs.
class Table : public ::testing::Environment {
 public:
  void TearDown() override {
    if (std::getenv("WAM_CAMPAIGN_RUNS") == nullptr) return;
    std::printf("%-32s %5s %9s %9s %10s %9s %6s  %s\n", "fault", "runs", "step", "torque", "moved",
                "sinking", "kept", "hardware afterwards");
    for (const auto& [name, all] : campaign_table()) print(name, all);
  }

 private:
  static void print(const std::string& name, const CampaignFigures& all) {
    std::string states;
    for (const std::string& state : all.states) states += (states.empty() ? "" : "; ") + state;
    const std::string kept = all.cycles_kept ? std::to_string(*all.cycles_kept) : "-";
    std::printf("%-32s %5d %9.3f %9.3f %10.5f %9.2f %6s  %s\n", name.c_str(), all.runs, all.step,
                all.torque, all.moved, all.sinking, kept.c_str(), states.c_str());
    for (const int number : all.failed) std::printf("%-32s FAILED: run %d\n", name.c_str(), number);
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
  for (const int number : numbers_of_runs()) {
    SCOPED_TRACE("run " + std::to_string(number) + " of " + name);
    const int before = failures();
    run(number);
    CampaignFigures& figures = campaign_table()[name];
    ++figures.runs;
    if (failures() != before) figures.failed.push_back(number);
  }
}

}  // namespace armature::wam
