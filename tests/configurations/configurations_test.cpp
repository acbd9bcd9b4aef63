// SPDX-License-Identifier: Apache-2.0
// What passes the check does not move the robot: mutants of every deployment that is shipped, tried
// out on the simulated robots and judged by where these really are.
//
//     CONFIGURATIONS=1000 configurations_campaign     as many of each robot, and a table of them
//     CONFIGURATION=17 configurations_campaign        this one only, and what is said of it
//     CONFIGURATIONS_TOLD=1 configurations_campaign   each one, and what share of its bounds each
//     phase used
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "armature/deploy/deployment.hpp"
#include "tests/configurations/in_child.hpp"
#include "tests/configurations/mutation.hpp"
#include "tests/configurations/trial.hpp"

namespace armature::configurations {
namespace {

/// Mutants of each robot in an ordinary test run: the first ones, whatever they are.
constexpr unsigned kUsually = 6;

constexpr Outcome kOutcomes[] = {Outcome::kRefused, Outcome::kNotStarted, Outcome::kNotArmed,
                                 Outcome::kFaulted, Outcome::kQuiet,      Outcome::kUnsafe};

std::optional<unsigned> number_in_environment(const char* name) {
  const char* text = std::getenv(name);
  if (text == nullptr) return std::nullopt;
  return static_cast<unsigned>(std::atoi(text));
}

bool is_told() { return std::getenv("CONFIGURATIONS_TOLD") != nullptr; }

document::Document document_of(const Shipped& shipped) {
  base::Diagnostics diagnostics;
  deploy::LoadOptions options;
  options.overrides = shipped.overrides;
  document::Document document = deploy::load_document(shipped.file, options, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.to_text();
  return document;
}

/// `wam/deployments/npid4.yaml, bus=can0`
std::string name_of(const Shipped& shipped) {
  std::string name = shipped.file.substr(std::string(SOURCE "/").size());
  for (const std::string& each : shipped.overrides) name += ", " + each;
  return name;
}

Verdict verdict_of(const ChildEnd& end) {
  if (!end.problem.empty() || end.written.empty()) return {Outcome::kUnsafe, end.problem};
  return {static_cast<Outcome>(end.written[0] - '0'), end.written.substr(1)};
}

Verdict tried_out(const RobotUnderTest& robot, const document::Document& document) {
  const std::string folder = ::testing::TempDir() + "configurations-" + std::to_string(::getpid());
  std::filesystem::create_directories(folder);
  const Verdict verdict = verdict_of(run_in_child([&] {
    const Verdict found = try_out(robot, document, folder);
    return std::to_string(static_cast<int>(found.outcome)) + found.why;
  }));
  std::filesystem::remove_all(folder);
  return verdict;
}

/// A deployment with one change, seldom two.
struct Mutant {
  Mutant(const RobotUnderTest& robot, unsigned seed)
      : shipped(robot.deployments[seed % robot.deployments.size()]),
        document(document_of(shipped)) {
    Random random(seed);
    const Mutation first = mutate(document, random);
    kind = first.kind;
    what = first.what;
    if (random() % 5 == 0) what += "; " + mutate(document, random).what;
  }

  Shipped shipped;
  document::Document document;
  std::string kind;
  std::string what;
};

/// How many mutants of each kind ended how.
class Table {
 public:
  void add(const std::string& kind, Outcome outcome) { ++all_[kind][outcome]; }

  void print(const char* robot) {
    std::printf("%-12s", robot);
    for (const Outcome outcome : kOutcomes) std::printf(" %11s", name_of(outcome));
    std::printf("\n");
    std::map<Outcome, int> sum;
    for (auto& [kind, counts] : all_) {
      print_row(kind, counts);
      for (const Outcome outcome : kOutcomes) sum[outcome] += counts[outcome];
    }
    print_row("all", sum);
    std::printf("\n");
  }

 private:
  static void print_row(const std::string& kind, std::map<Outcome, int>& counts) {
    std::printf("%-12s", kind.c_str());
    for (const Outcome outcome : kOutcomes) std::printf(" %11d", counts[outcome]);
    std::printf("\n");
  }

  std::map<std::string, std::map<Outcome, int>> all_;
};

void try_mutant(const RobotUnderTest& robot, unsigned seed, bool tell, Table& table) {
  const Mutant mutant(robot, seed);
  const Verdict verdict = tried_out(robot, mutant.document);
  table.add(mutant.kind, verdict.outcome);
  const std::string text = std::string(robot.name) + " " + std::to_string(seed) + ", " +
                           name_of(mutant.shipped) + ", " + mutant.what + ": " +
                           name_of(verdict.outcome) + ", " + verdict.why;
  if (tell) std::printf("%s\n", text.c_str());
  EXPECT_NE(verdict.outcome, Outcome::kUnsafe) << text;
}

void try_mutants(const RobotUnderTest& robot) {
  Table table;
  if (const auto only = number_in_environment("CONFIGURATION")) {
    return try_mutant(robot, *only, true, table);
  }
  const auto asked = number_in_environment("CONFIGURATIONS");
  for (unsigned seed = 0; seed < asked.value_or(kUsually); ++seed) {
    try_mutant(robot, seed, is_told(), table);
  }
  if (asked) table.print(robot.name);
}

/// Otherwise a mutant that does nothing at all would be quiet, too.
void try_what_is_shipped(const RobotUnderTest& robot) {
  for (const Shipped& shipped : robot.deployments) {
    if (is_told()) std::printf("%s\n", name_of(shipped).c_str());
    const Verdict verdict = tried_out(robot, document_of(shipped));
    const Outcome expected = shipped.has_robot ? Outcome::kQuiet : Outcome::kNotArmed;
    EXPECT_EQ(verdict.outcome, expected) << name_of(shipped) << ": " << verdict.why;
    EXPECT_EQ(verdict.why, "") << name_of(shipped);
  }
}

/// A change that was unsafe when the campaign was first run.
struct KnownMutant {
  RobotUnderTest robot;
  const char* file;
  const char* change;  ///< as on the command line
};

std::vector<KnownMutant> known_mutants() {
  return {{wam4(), "/robots/wam/deployments/npid4.yaml", "Sampler.activity.periodic=200 ms"},
          {wam7(), "/robots/wam/deployments/npid7.yaml", "Sampler.activity.periodic=20 ms"},
          {wam7(), "/robots/wam/deployments/npid7.yaml", "period=20 ms"},
          {wam4(), "/robots/wam/deployments/controller_wam4.yaml", "WAM.gravity=[0, 0, -98.05]"},
          {wam4(), "/robots/wam/deployments/modes4.yaml", "WAM.gravity=[0, 0, 9.805]"},
          {wam7(), "/robots/wam/deployments/controller_wam7.yaml", "controller_has_gravity=true"},
          {wam4(), "/robots/wam/deployments/gravity_pd4.yaml",
           "Controller.Kp=[90000, 250000, 60000, 50000]"},
          {wam4(), "/robots/wam/deployments/npid4.yaml", "PID4.Kd=0"},
          {wam7(), "/robots/wam/deployments/gravity_pd7.yaml", "Controller.gravity=[0, 0, -9805]"},
          {wam7(), "/robots/wam/deployments/gravity_pd7.yaml",
           "WAM.MaxTorque=[0.6, 0.6, 0.45, 0.3, 0.1, 0.1, 0.05]"},
          {wam4(), "/robots/wam/deployments/gravity_pd4.yaml",
           "WAM.MaxTorqueGrowth=[0.05, 0.05, 0.04, 0.03]"},
          {wam7(), "/robots/wam/deployments/controller_wam7.yaml",
           "WAM.Kp=[900000, 2500000, 600000, 500000, 50000, 50000, 8000]"},
          {janus(), "/robots/janus/deployments/pid.yaml", "Joint1.GearRatio=0.03"},
          {janus(), "/robots/janus/deployments/pid.yaml", "Robot.motor_gear_ratio=[]"},
          {wam7(), "/robots/wam/deployments/gravity_pd7.yaml",
           "WAM.MaxTorqueGrowth=[3, 3, 2.25, 1.4, 0.5, 0.5, 0.065]"},  // as slow as is accepted
          {own_robot(), "/examples/07_own_robot/arm.yaml", "PID3.Kp=0.15"},
          {own_robot(), "/examples/07_own_robot/arm.yaml", "PID2.Ki=600"},
          {cia402_arm(), "/examples/12_cia402/position.yaml", "Joint2.GearRatio=0.1"},
          {cia402_arm(), "/examples/12_cia402/torque.yaml", "Joint1.GearRatio=100"},
          {cia402_arm(), "/examples/12_cia402/velocity.yaml", "Controller.Kp=[2000]"},
          {cia402_arm(), "/examples/12_cia402/velocity.yaml", "Sampler.activity.periodic=50 ms"}};
}

TEST(KnownMutants, AreRefusedOrMoveWithinBounds) {
  for (const KnownMutant& known : known_mutants()) {
    const Verdict verdict =
        tried_out(known.robot, document_of({std::string(SOURCE) + known.file, {known.change}}));
    if (is_told()) {
      std::printf("%s, %s: %s, %s\n", known.file, known.change, name_of(verdict.outcome),
                  verdict.why.c_str());
    }
    EXPECT_NE(verdict.outcome, Outcome::kUnsafe)
        << known.file << ", " << known.change << ": " << verdict.why;
  }
}

TEST(ShippedConfigurations, OfJanusStandHoldMoveAndStop) { try_what_is_shipped(janus()); }
TEST(ShippedConfigurations, OfTheWamStandHoldMoveAndStop) {
  try_what_is_shipped(wam4());
  try_what_is_shipped(wam7());
}
TEST(ShippedConfigurations, OfAnOwnRobotStandHoldMoveAndStop) { try_what_is_shipped(own_robot()); }
TEST(ShippedConfigurations, OfDrivesByCia402StandHoldMoveAndStop) {
  try_what_is_shipped(cia402_arm());
}
TEST(ShippedConfigurations, OfTheRoverStandDriveAndStop) { try_what_is_shipped(rover()); }

TEST(MutantConfigurations, OfJanusAreRefusedOrMoveWithinBounds) { try_mutants(janus()); }
TEST(MutantConfigurations, OfTheWamWithFourJointsAreRefusedOrMoveWithinBounds) {
  try_mutants(wam4());
}
TEST(MutantConfigurations, OfTheWamWithSevenJointsAreRefusedOrMoveWithinBounds) {
  try_mutants(wam7());
}
TEST(MutantConfigurations, OfTheRoverAreRefusedOrMoveWithinBounds) { try_mutants(rover()); }
TEST(MutantConfigurations, OfAnOwnRobotAreRefusedOrMoveWithinBounds) { try_mutants(own_robot()); }
TEST(MutantConfigurations, OfDrivesByCia402AreRefusedOrMoveWithinBounds) {
  try_mutants(cia402_arm());
}

}  // namespace
}  // namespace armature::configurations
