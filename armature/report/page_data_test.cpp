// SPDX-License-Identifier: Apache-2.0
#include "armature/report/page_data.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "armature/report/internal/page_curves.hpp"

namespace armature::report {
namespace {

using ::testing::ElementsAre;

/// As page/curves.js does it; what is null stays nan.
std::vector<double> unpacked(const Json& differences, double per) {
  std::vector<double> values;
  double sum = 0.0;
  for (const Json& each : differences) {
    if (!each.is_null()) sum += each.get<double>();
    values.push_back(each.is_null() ? std::numeric_limits<double>::quiet_NaN() : sum / per);
  }
  return values;
}

Run run_of(const std::string& name, std::size_t samples) {
  Run run;
  run.name = name;
  Signal signal{"A.Out", "V", "", {}, {}};
  for (std::size_t i = 0; i < samples; ++i) {
    signal.time_s.push_back(0.01 * static_cast<double>(i));
    signal.values.push_back(std::sin(0.37 * static_cast<double>(i)));
  }
  run.signals.all.push_back(signal);
  return run;
}

TEST(PageCurves, HaveEachValueToFiveDigits) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Signal signal{"A", "", "", {0.0, 0.01, 0.02, 0.03}, {12.3456, none, -0.00012, 12.0}};
  const Json packed = internal::packed(signal, 100);
  const auto values = unpacked(packed["v"], packed["per"].get<double>());
  EXPECT_NEAR(values[0], 12.3456, 1e-3);
  EXPECT_TRUE(std::isnan(values[1]));
  EXPECT_NEAR(values[2], 0.0, 1e-3);
  EXPECT_NEAR(values[3], 12.0, 1e-3);
  const auto times = unpacked(packed["t"], 1e4);
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(times[i], signal.time_s[i], 1e-9);
}

TEST(PageCurves, OfNothingButZerosOrNothingAtAllArePacked) {
  EXPECT_THAT(unpacked(internal::packed({"A", "", "", {0.0, 1.0}, {0.0, 0.0}}, 10)["v"], 1.0),
              ElementsAre(0.0, 0.0));
  EXPECT_TRUE(internal::packed({"A", "", "", {}, {}}, 10)["v"].empty());
}

TEST(PageData, IsThinnedUntilItFitsAndKeepsMinimaAndMaxima) {
  Runs runs;
  for (const std::string name : {"one", "two", "three"}) {
    runs.runs.push_back(run_of(name, 200'000));
    auto& values = runs.runs.back().signals.all[0].values;
    values[1234] = 7.5;
    values[4321] = -9.5;
    for (int i = 0; i < 40; ++i) {
      runs.runs.back().signals.all.push_back(runs.runs.back().signals.all[0]);
    }
  }
  const std::string all = page_json(runs);
  constexpr std::size_t kMost = 300'000;
  ASSERT_GT(all.size(), kMost);
  const std::string few = page_json(runs, kMost);
  EXPECT_LE(few.size(), kMost);
  EXPECT_GT(few.size(), kMost / 4) << "thinner than need be";
  const Json page = Json::parse(few);
  ASSERT_FALSE(page["runs"].empty());
  for (const Json& run : page["runs"]) {
    for (const Json& curve : run["others"]) {
      const auto values = unpacked(curve["v"], curve["per"].get<double>());
      EXPECT_NEAR(*std::ranges::max_element(values), 7.5, 1e-4);
      EXPECT_NEAR(*std::ranges::min_element(values), -9.5, 1e-4);
    }
  }
}

TEST(PageData, OfMoreComplaintsThanAnybodyReadsCountsTheRest) {
  Json summary{{"application", "a"}, {"complaints", Json::array()}, {"complaints_left_out", 5}};
  for (int i = 0; i < 300; ++i) summary["complaints"].push_back({{"message", std::to_string(i)}});
  Runs runs;
  runs.runs.push_back(run_of("one", 10));
  runs.runs[0].summary = summary.dump();
  const Json shown = Json::parse(page_json(runs))["runs"][0]["summary"];
  EXPECT_EQ(shown["complaints"].size(), 100u);
  EXPECT_EQ(shown["complaints_left_out"], 205);
}

TEST(PageTitle, IsTheApplication) {
  Runs runs{"build/demo", {}, {}, {}};
  runs.runs.push_back(run_of("one", 10));
  EXPECT_EQ(title_of(runs), "build/demo") << "nothing else is known";
  for (const std::string name : {"janus-pid", "janus-pid", "wave"}) {
    runs.runs.push_back(run_of(name, 10));
    runs.runs.back().summary = Json{{"application", name}}.dump();
  }
  EXPECT_EQ(title_of(runs), "janus-pid, wave");
  for (const std::string name : {"c", "d", "e"}) {
    runs.runs.push_back(run_of(name, 10));
    runs.runs.back().summary = Json{{"application", name}}.dump();
  }
  EXPECT_EQ(title_of(runs), "janus-pid, wave, c and 2 more");
  EXPECT_EQ(Json::parse(page_json(runs))["title"], "janus-pid, wave, c and 2 more");
}

}  // namespace
}  // namespace armature::report
