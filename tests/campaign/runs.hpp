// SPDX-License-Identifier: Apache-2.0
// How often what may break breaks in a campaign.
//
//     WAM_CAMPAIGN_RUNS=1000 wam_deployed_campaign    as many runs of each, and a table
//     WAM_CAMPAIGN_RUN=16 wam_deployed_campaign       that run of each, such as one that failed
#pragma once

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace armature::campaign {

/// What all runs of a breakage have in common.
struct Account {
  int runs = 0;
  std::vector<int> failed{};       ///< their numbers
  std::set<std::string> states{};  ///< how the robot was afterwards
};

inline std::optional<int> number_in_environment(const std::string& name) {
  const char* text = std::getenv(name.c_str());
  if (text == nullptr) return std::nullopt;
  return std::atoi(text);
}

/// Runs in tests that nobody asked for more.
constexpr int kRunsInTests = 3;

/// @param campaign  as the environment begins: `WAM` of `WAM_CAMPAIGN_RUNS`
inline std::vector<int> numbers_of_runs(const std::string& campaign, int in_tests = kRunsInTests) {
  if (const auto only = number_in_environment(campaign + "_CAMPAIGN_RUN")) return {*only};
  const auto asked = number_in_environment(campaign + "_CAMPAIGN_RUNS");
  std::vector<int> all(static_cast<std::size_t>(asked.value_or(in_tests)));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// Somebody has asked for many runs.
inline bool wants_table(const std::string& campaign) {
  return number_in_environment(campaign + "_CAMPAIGN_RUNS").has_value();
}

/// Calls `run` with the number of each run, which is its seed, within a test. A run that fails does
/// not keep the others from being made.
inline void make_runs(const std::string& campaign, const std::string& name, Account& account,
                      const std::function<void(int)>& run, int in_tests = kRunsInTests) {
  const auto failures = [] {
    return ::testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count();
  };
  for (const int number : numbers_of_runs(campaign, in_tests)) {
    SCOPED_TRACE("run " + std::to_string(number) + " of " + name);
    const int before = failures();
    run(number);
    ++account.runs;
    if (failures() != before) account.failed.push_back(number);
  }
}

/// Of a table, behind its figures.
inline std::string states_of(const Account& account) {
  std::string text;
  for (const std::string& state : account.states) text += (text.empty() ? "" : "; ") + state;
  return text;
}

/// A line for each run that failed.
inline void print_failed(const std::string& name, const Account& account) {
  for (const int number : account.failed) {
    std::printf("%-32s FAILED: run %d\n", name.c_str(), number);
  }
}

}  // namespace armature::campaign
