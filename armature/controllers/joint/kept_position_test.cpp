// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/joint/kept_position.hpp"

#include <chrono>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/controllers/internal/test_joint.hpp"

namespace armature::controllers {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr auto kNow = std::chrono::sys_days{std::chrono::year{2026} / 1 / 10} + 0s;

LastPosition at(double position, std::string date = "2026-01-02T03:04:05Z") {
  return {.position = position, .date = std::move(date), .owner = "head/Joint1", .at_rest = true};
}

/// The joint of JointTest with `autosave`; the deployment has it begin at 1 rad.
class KeptPositionTest : public JointTest {
 protected:
  KeptPositionTest() {
    joint.serve<bool()>("positionKnown", [this] {
      if (std::exchange(word, false)) doubted = false;
      return !doubted;
    });
    joint.serve<bool()>("doubtPosition", [this] { return doubted = true; });
    joint.serve<bool()>("positionExact", [this] { return exact; });
  }

  component::Keeping& keeping() {
    return dynamic_cast<component::Keeps&>(joint.component()).keeping();
  }
  /// What the reader of the deployment is told of what the file has.
  std::string take(const LastPosition& found) {
    joint.set("LastPosition", found);
    base::Diagnostics diagnostics;
    keeping().take({"head/Joint1", kNow}, {"head.yaml", 3, 1}, diagnostics);
    return diagnostics.to_text();
  }
  void start_with(const LastPosition& found) {
    take(found);
    keeping().begin({"head/Joint1", kNow});
    start();
  }
  /// Why nothing is kept.
  std::string end(std::chrono::seconds later = 0s) {
    return keeping().end(
        {"head/Joint1",
         std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now()) + later});
  }
  LastPosition kept() { return joint.get<LastPosition>("LastPosition"); }

  bool doubted = false;
  bool word = false;  ///< the operator's, which counts once
  bool exact = true;
};

TEST_F(KeptPositionTest, IsWhereTheJointBeginsAndNotBelievedBeforeTheOperatorHasConfirmedIt) {
  EXPECT_EQ(take(at(2.5)), "");
  start();
  EXPECT_DOUBLE_EQ(position(), 2.5);
  sample(10.0);  // by hand
  arm();
  EXPECT_FALSE(armed());
  EXPECT_THAT(joint.log(), Contains(HasSubstr("not armed: it began at 2.5 rad, where it was on "
                                              "2026-01-02T03:04:05Z: look whether it is where its "
                                              "Position says, 2.6 rad, then set "
                                              "position_confirmed of its hardware")));
  word = true;
  arm();
  EXPECT_TRUE(armed());
}

TEST_F(KeptPositionTest, IsAskedForAgainAtEachStartUntilItIsConfirmedAndNotAfterwards) {
  start_with(at(2.5));
  joint.stop();
  doubted = false;
  start();
  EXPECT_TRUE(doubted) << "nobody has looked";
  word = true;
  arm();
  ASSERT_TRUE(armed());
  joint.stop();
  start();
  EXPECT_FALSE(doubted);
}

TEST_F(KeptPositionTest, WithoutAutosaveNothingIsDoubted) {
  joint.set("LastPosition", at(2.5));
  start();
  EXPECT_FALSE(doubted);
  EXPECT_DOUBLE_EQ(position(), 1.0);
}

TEST_F(KeptPositionTest, ThatCannotBeIsRefusedWithItsReason) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  LastPosition of_another = at(2.5);
  of_another.owner = "head/Joint2";
  LastPosition half = at(2.5);
  half.owner.clear();
  const std::vector<std::pair<LastPosition, std::string>> wrong{
      {of_another, "is of 'head/Joint2', expected 'head/Joint1'"},
      {half, "is of '', expected 'head/Joint1'"},
      {at(2.5, "2026-01-0"), "has the date '2026-01-0', expected one like"},
      {at(2.5, "2026-02-30T00:00:00Z"), "has the date '2026-02-30T00:00:00Z', expected one like"},
      {at(2.5, "2026-01-11T00:00:00Z"), "which is to come: it is 2026-01-10T00:00:00Z"},
      {at(4.6), "is 4.6 rad, expected -0.5 to 4.5 rad"},
      {at(nan), "is nan rad, expected"}};
  for (const auto& [found, why] : wrong) {
    EXPECT_THAT(take(found),
                AllOf(StartsWith("head.yaml:3:1: error: 'Joint1': LastPosition "), HasSubstr(why)));
  }
  start();
  EXPECT_DOUBLE_EQ(position(), 1.0);
  EXPECT_TRUE(doubted);
}

TEST_F(KeptPositionTest, ThatTellsNothingAnyMoreIsNotProposedAndTheOperatorIsAskedNevertheless) {
  LastPosition crashed = at(2.5);
  crashed.at_rest = false;
  const std::vector<std::pair<LastPosition, std::string>> told{
      {{}, "no position is kept yet"},
      {at(2.5, "2025-12-10T00:00:00Z"), "2025-12-10T00:00:00Z, more than 30 days ago"},
      {crashed, "the run of 2026-01-02T03:04:05Z did not end with the joint at rest"}};
  for (const auto& [found, why] : told) {
    EXPECT_THAT(take(found), AllOf(StartsWith("head.yaml:3:1: warning: 'Joint1' begins at "
                                              "InitialPos, 1 rad: "),
                                   HasSubstr(why)));
  }
  start();
  EXPECT_DOUBLE_EQ(position(), 1.0);
  arm();
  EXPECT_FALSE(armed());
  EXPECT_THAT(joint.log(), Contains(HasSubstr("it began at InitialPos, as its last position is "
                                              "not known: look whether it is where its Position "
                                              "says, 1 rad")));
}

TEST_F(KeptPositionTest, SaysFromTheStartOnThatARunHasBegun) {
  start_with(at(2.5));
  EXPECT_FALSE(kept().at_rest);
  EXPECT_EQ(kept().date, "2026-01-10T00:00:00Z");
  keeping().give_back();
  EXPECT_TRUE(kept().at_rest);
  EXPECT_EQ(kept().date, "2026-01-02T03:04:05Z");
}

TEST_F(KeptPositionTest, OfAnOrderlyEndIsWhatWasMeasuredLast) {
  start_with(at(2.5));
  word = true;
  arm();
  ASSERT_TRUE(armed());
  sample(1.0);
  sample();
  joint.stop();
  EXPECT_EQ(end(), "");
  EXPECT_DOUBLE_EQ(kept().position, 2.51);
  EXPECT_TRUE(kept().at_rest);
  EXPECT_EQ(kept().owner, "head/Joint1");
  EXPECT_NE(kept().date, "2026-01-10T00:00:00Z");
}

TEST_F(KeptPositionTest, ThatNobodyConfirmedKeepsItsDate) {
  start_with(at(2.5));
  joint.stop();
  EXPECT_EQ(end(), "");
  EXPECT_DOUBLE_EQ(kept().position, 2.5);
  EXPECT_EQ(kept().date, "2026-01-02T03:04:05Z");
}

TEST_F(KeptPositionTest, ThatNobodyConfirmedIsNotMadeOfInitialPos) {
  start_with({});
  joint.stop();
  EXPECT_EQ(end(), "the operator did not confirm where it began");
  EXPECT_FALSE(kept().at_rest);
}

TEST_F(KeptPositionTest, IsKeptOnlyOfAJointThatIsKnownToRestWhereItIs) {
  const auto run = [this](auto before_the_stop) {
    start_with(at(2.5));
    before_the_stop();
    joint.stop();
    const std::string why = end();
    EXPECT_FALSE(kept().at_rest) << why;
    return why;
  };
  EXPECT_EQ(run([this] { sample(1.0); }), "it was not measured at rest when it stopped");
  EXPECT_EQ(run([this] { joint.advance(1s); }), "it was not measured at rest when it stopped");
  EXPECT_EQ(run([this] { exact = false; }), "a sample of it was lost");
  exact = true;
  EXPECT_EQ(run([this] { broken = "brakeApply"; }), "its brake did not confirm that it holds");
  broken = {};
  EXPECT_THAT(run([this] {
                sample(250.0);
                sample();
              }),
              HasSubstr("rad, outside -0.5 to 4.5 rad"));
}

TEST_F(KeptPositionTest, IsNotKeptOfAJointThatDidNotStopInOrder) {
  start_with(at(2.5));
  EXPECT_EQ(end(), "it did not stop in order");
  EXPECT_FALSE(kept().at_rest);
}

TEST_F(KeptPositionTest, IsNotKeptOfAJointThatStoppedLongBeforeTheRunEnded) {
  start_with(at(2.5));
  joint.stop();
  EXPECT_EQ(end(11s), "it was stopped long before the run ended");
  EXPECT_FALSE(kept().at_rest);
}

TEST_F(KeptPositionTest, IsNotWhatAToolMadeOfItMeanwhile) {
  start_with(at(2.5));
  exact = false;
  joint.stop();
  joint.set("LastPosition", at(0.0));
  EXPECT_NE(end(), "");
  EXPECT_FALSE(kept().at_rest);
}

TEST(KeptPositionOfAnyHardware, NeedsHardwareThatAsksTheOperator) {
  testing::Harness joint{std::make_unique<Joint>("Joint1")};
  for (const char* name : {"PositionMax", "MaxVelocity", "MaxAcceleration", "MaxVoltage"}) {
    joint.set(name, 5.0);
  }
  joint.set("PeerName", "Card");
  joint.set("GearRatio", 1.0);
  joint.set("Sampler", false);
  joint.set("Period", 0.01);
  base::Diagnostics diagnostics;
  dynamic_cast<component::Keeps&>(joint.component())
      .keeping()
      .take({"head/Joint1", kNow}, {}, diagnostics);
  EXPECT_THAT(std::string(joint.start().reason()),
              HasSubstr("autosave needs hardware that asks the operator for position_confirmed, "
                        "and 'Card' does not"));
}

}  // namespace
}  // namespace armature::controllers
