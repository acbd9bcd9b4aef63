// SPDX-License-Identifier: Apache-2.0
#include "armature/report/phases.hpp"

#include <gmock/gmock.h>

#include "armature/report/figures.hpp"

namespace armature::report {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Optional;

/// Cycles of one thread every 10 ms, whose steps are at the same places in each.
StepTrace cycles_with(const std::vector<StepTrace::Event>& steps, int count = 5) {
  StepTrace trace;
  for (int k = 0; k < count; ++k) {
    const double begin_us = 10'000.0 * k;
    trace.cycles.push_back({"cycle", begin_us, 1000.0, 1});
    for (StepTrace::Event step : steps) {
      step.begin_us += begin_us;
      trace.steps.push_back(step);
    }
  }
  return trace;
}

/// A joint and its card, a PID, and the joint again, which actuates; in another thread a reporter.
StepTrace cycles() {
  return cycles_with({{"Joint", 0, 10, 1},
                      {"Card", 10, 200, 1},
                      {"Joint", 210, 5, 1},
                      {"PID", 215, 30, 1},
                      {"Joint", 245, 7, 1},
                      {"Reporter", 5000, 90, 2}});
}

Phase phase_of(std::vector<std::string> components) {
  return {.name = "phase", .components = std::move(components)};
}

TEST(Phases, OfAComponentIsAllThatItDidInACycle) {
  EXPECT_THAT(computing_of(phase_of({"PID"}), cycles()), Optional(DoubleNear(30.0, 1e-9)));
  EXPECT_THAT(computing_of(phase_of({"Joint", "Card"}), cycles()),
              Optional(DoubleNear(222.0, 1e-9)));
}

TEST(Phases, OfAnotherThreadIsWhatItDidUntilTheNextCycle) {
  EXPECT_THAT(computing_of(phase_of({"Reporter"}), cycles()), Optional(DoubleNear(90.0, 1e-9)));
}

TEST(Phases, AComponentThatRunsTwiceIsToldApartByWhatRunsInBetween) {
  Phase sensing = phase_of({"Joint", "Card"});
  sensing.before = "PID";
  EXPECT_THAT(computing_of(sensing, cycles()), Optional(DoubleNear(215.0, 1e-9)));
  Phase actuation = phase_of({"Joint", "Card"});
  actuation.after = "PID";
  EXPECT_THAT(computing_of(actuation, cycles()), Optional(DoubleNear(7.0, 1e-9)));
}

TEST(Phases, HaveNoTimeWithoutTheComponentsOrTheirBounds) {
  EXPECT_EQ(computing_of(phase_of({"Brake"}), cycles()), std::nullopt);
  for (const bool before : {true, false}) {
    Phase bounded = phase_of({"Joint"});
    (before ? bounded.before : bounded.after) = "Brake";
    EXPECT_EQ(computing_of(bounded, cycles()), std::nullopt);
  }
  EXPECT_EQ(computing_of(phase_of({"Joint"}), {}), std::nullopt);
}

TEST(Phases, TheirTimeIsTheMedianOfTheCycles) {
  StepTrace trace = cycles_with({{"PID", 0, 30, 1}}, 6);
  const double lengths[] = {5.0, 900.0, 31.0, 30.0, 2.0, 7777.0};
  for (std::size_t k = 0; k < 6; ++k) trace.steps[k].length_us = lengths[k];
  // The last cycle has no next to end it.
  EXPECT_THAT(computing_of(phase_of({"PID"}), trace), Optional(DoubleNear(30.0, 1e-9)));
}

Phases parse(const std::string& text, std::string& mistakes) {
  base::Diagnostics diagnostics;
  Phases phases = parse_phases(text, "phases.json", diagnostics);
  mistakes = diagnostics.to_text();
  EXPECT_EQ(diagnostics.ok(), mistakes.empty());
  return phases;
}

TEST(Phases, AreReadWithTheirNamesInTheirOrder) {
  std::string mistakes;
  const Phases phases = parse(
      R"({"elsewhere": "another robot", "phases": [
           {"name": "sense", "components": ["Joint", "Card"], "before": "PID", "bus": "/io/bus_us",
            "elsewhere_us": 259},
           {"name": "compute", "components": ["PID"]}]})",
      mistakes);
  EXPECT_EQ(mistakes, "");
  EXPECT_EQ(phases.elsewhere, "another robot");
  ASSERT_EQ(phases.all.size(), 2u);
  EXPECT_EQ(phases.all[0].name, "sense");
  EXPECT_THAT(phases.all[0].components, ElementsAre("Joint", "Card"));
  EXPECT_EQ(phases.all[0].before, "PID");
  EXPECT_EQ(phases.all[0].bus, "/io/bus_us");
  EXPECT_THAT(phases.all[0].elsewhere_us, Optional(259.0));
  EXPECT_EQ(phases.all[1].elsewhere_us, std::nullopt);
}

TEST(Phases, MistakesAreToldWithTheirPhase) {
  std::string mistakes;
  parse("", mistakes);
  EXPECT_EQ(mistakes, "");
  parse(R"({"phase": []})", mistakes);
  EXPECT_THAT(mistakes, HasSubstr("phases.json: error: expected an object with a list `phases`"));
  parse(R"({"phases": [5, {"components": ["A"]}, {"name": "n"}, {"name": "m", "components": [1]},
                       {"name": "o", "components": "A"},
                       {"name": "p", "components": ["A"], "bus": "bus_us"}]})",
        mistakes);
  for (const char* told :
       {"phase 1, '', is no object", "phase 2, '', has no name",
        "phase 3, 'n', needs a list of names, components", "phase 4, 'm', needs a list of names",
        "phase 5, 'o', needs a list of names",
        "phase 6, 'p', has the bus time 'bus_us', expected"}) {
    EXPECT_THAT(mistakes, HasSubstr(told));
  }
}

TEST(Phases, StandInReportJsonWithTheirTimeOnTheBus) {
  Runs runs;
  runs.cycle_json = R"({"slow": {"bus_us": 200}})";
  runs.phases.all = {
      {.name = "sense", .components = {"Joint"}, .bus = "/io/slow/bus_us", .elsewhere_us = 259.0},
      {.name = "compute", .components = {"PID"}},
      {.name = "act", .components = {"Joint"}, .bus = "/io/fast/bus_us"}};
  report::Run run;
  run.name = "realtime";
  run.phase_computing_us = {15.0, 30.0, 7.0};
  runs.runs = {run};
  const std::string report = figures_json(runs);
  EXPECT_THAT(report, HasSubstr(R"("name": "sense",
          "us": 215.0,
          "computing_us": 15.0,
          "bus_us": 200.0,
          "elsewhere_us": 259.0)"));
  EXPECT_THAT(report, HasSubstr(R"("name": "compute",
          "us": 30.0,
          "computing_us": 30.0,
          "elsewhere_us": null)"));
  EXPECT_THAT(report, HasSubstr(R"("name": "act",
          "us": null,
          "computing_us": 7.0,
          "bus_us": null)"))
      << "it uses a bus that nobody measured";
}

}  // namespace
}  // namespace armature::report
