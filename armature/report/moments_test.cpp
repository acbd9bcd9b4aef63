// SPDX-License-Identifier: Apache-2.0
#include "armature/report/moments.hpp"

#include <gmock/gmock.h>

#include "armature/report/internal/json.hpp"

namespace armature::report {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Told {
  double time_s;
  std::string kind;
  std::string component;
  std::string message;
};

std::string summary(double begin_s, const std::vector<Told>& moments) {
  Json run{{"begin_s", begin_s}, {"moments", Json::array()}};
  for (const Told& one : moments) {
    run["moments"].push_back({{"time_s", one.time_s},
                              {"kind", one.kind},
                              {"component", one.component},
                              {"message", one.message}});
  }
  return run.dump();
}

std::vector<std::pair<double, MomentKind>> kinds(const Moments& moments) {
  std::vector<std::pair<double, MomentKind>> all;
  for (const Moment& moment : moments.all) all.emplace_back(moment.time_s, moment.kind);
  return all;
}

TEST(MomentKinds, AreToldByLogLines) {
  EXPECT_EQ(moment_told_by("armed"), MomentKind::kArmed);
  EXPECT_EQ(moment_told_by("disarmed"), MomentKind::kDisarmed);
  EXPECT_EQ(moment_told_by("disarmed, and holds the arm where it is: asked"),
            MomentKind::kDisarmed);
  EXPECT_EQ(moment_told_by("the operator has idled the arm; it is disarmed"),
            MomentKind::kDisarmed);
  EXPECT_EQ(moment_told_by("fault: E-stop, positions are lost"), MomentKind::kEstop);
  EXPECT_EQ(moment_told_by("fault: exception: armed"), MomentKind::kFault);
  EXPECT_EQ(moment_told_by("stopped: 'Joint1' is lost"), MomentKind::kStopped);
  EXPECT_EQ(moment_told_by("reset"), MomentKind::kReset);
  EXPECT_EQ(moment_told_by("not armed: no power"), std::nullopt);
  EXPECT_EQ(moment_told_by("the safety board is in IDLE"), std::nullopt);
}

TEST(Moments, OfJointsThatAreArmedTogetherAreOne) {
  const Moments moments = moments_of(summary(0.0, {{0.41, "armed", "Joint1", "armed"},
                                                   {0.42, "armed", "Joint2", "armed"},
                                                   {5.0, "armed", "Joint1", "armed"}}),
                                     {}, 0.0);
  EXPECT_THAT(kinds(moments),
              ElementsAre(std::pair(0.41, MomentKind::kArmed), std::pair(5.0, MomentKind::kArmed)));
  EXPECT_THAT(moments.all[0].told, ElementsAre("Joint1: armed", "Joint2: armed"));
}

TEST(Moments, WhatFollowsFromAnEstopBelongsToIt) {
  const Moments moments =
      moments_of(summary(0.0, {{2.0, "disarmed", "WAM", "disarmed"},
                               {2.0, "E-stop", "WAM", "fault: E-stop, positions are lost"},
                               {2.01, "stopped", "Sensor", "stopped: 'WAM' is lost"},
                               {2.05, "reset", "WAM", "reset"},
                               {2.5, "disarmed", "WAM", "disarmed"}}),
                 {}, 0.0);
  EXPECT_THAT(kinds(moments),
              ElementsAre(std::pair(2.0, MomentKind::kEstop), std::pair(2.05, MomentKind::kReset),
                          std::pair(2.5, MomentKind::kDisarmed)));
  EXPECT_EQ(moments.all[0].told.size(), 3u);
}

TEST(Moments, OfARealRunStandOnTheAxisOfItsRecording) {
  const Moments moments =
      moments_of(summary(1000.0, {{1.5, "armed", "Joint1", "armed"}}), {}, 1000.25);
  EXPECT_THAT(kinds(moments), ElementsAre(std::pair(1.25, MomentKind::kArmed)));
}

TEST(Moments, OfArmingAreInTheSignals) {
  const Signals signals{{{"Joint1.Armed", "", "", {0.0, 1.0, 4.0}, {0.0, 1.0, 1.0}},
                         {"Joint2.Armed", "", "", {0.0, 2.0, 3.0}, {0.0, 1.0, 0.0}},
                         {"Joint2.ArmedTwice", "", "", {0.5}, {1.0}}},
                        {}};
  EXPECT_THAT(
      kinds(moments_of("", signals, 0.0)),
      ElementsAre(std::pair(2.0, MomentKind::kArmed), std::pair(3.0, MomentKind::kDisarmed)));
  const std::string fault = summary(0.0, {{3.05, "fault", "Joint2", "fault: broken"}});
  EXPECT_THAT(kinds(moments_of(fault, signals, 0.0)),
              ElementsAre(std::pair(2.0, MomentKind::kArmed), std::pair(3.0, MomentKind::kFault)));
}

TEST(Moments, ThatAreLoggedAndInTheSignalsAreOne) {
  const Signals signals{{{"Joint1.Armed", "", "", {0.0, 2.0, 4.0}, {0.0, 1.0, 0.0}}}, {}};
  const Moments moments =
      moments_of(summary(0.0, {{1.99, "armed", "Joint1", "armed"}}), signals, 0.0);
  EXPECT_THAT(kinds(moments), ElementsAre(std::pair(1.99, MomentKind::kArmed),
                                          std::pair(4.0, MomentKind::kDisarmed)));
  EXPECT_THAT(moments.all[0].told, ElementsAre("Joint1: armed"));
  EXPECT_THAT(moments.all[1].told, ElementsAre("not all joints are armed"));
}

TEST(Moments, OfASummaryThatHasNoneOrOtherThingsAreNone) {
  EXPECT_THAT(moments_of("", {}, 0.0).all, IsEmpty());
  EXPECT_THAT(moments_of("{}", {}, 0.0).all, IsEmpty());
  EXPECT_THAT(moments_of(R"({"begin_s": 0, "moments": [1, {}, {"time_s": "x", "kind": "armed"},
                             {"time_s": 1, "kind": "asleep"}, {"time_s": 1, "kind": 5}]})",
                         {}, 0.0)
                  .all,
              IsEmpty());
}

TEST(Moments, OfMoreThanAPageCanShowAreCounted) {
  std::vector<Told> many;
  for (int i = 0; i < 250; ++i) many.push_back({2.0 * i, "reset", "A", "reset"});
  const Moments moments = moments_of(summary(0.0, many), {}, 0.0);
  EXPECT_EQ(moments.all.size(), 200u);
  EXPECT_EQ(moments.left_out, 50u);
}

}  // namespace
}  // namespace armature::report
