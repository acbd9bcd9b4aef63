// SPDX-License-Identifier: Apache-2.0
#include "armature/control/arming/gathering.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::control {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Gathering make(std::size_t members, std::size_t values_each = 1, int max_missing = 3) {
  return Gathering::make({members, values_each, max_missing}).value();
}

/// A round in which both of two members answer.
void complete_round(Gathering& gathering, double first, double second) {
  gathering.begin();
  gathering.add(0, first);
  ASSERT_TRUE(gathering.add(1, second));
}

TEST(Gathering, IsCompleteWithTheLastValueInWhateverOrder) {
  auto gathering = make(2, 2);
  EXPECT_FALSE(gathering.begin().complete);
  EXPECT_FALSE(gathering.add(1, 0.3, 1));
  EXPECT_FALSE(gathering.add(0, 0.0));
  EXPECT_FALSE(gathering.add(0, 0.2, 1));
  EXPECT_TRUE(gathering.add(1, 0.1));
  EXPECT_THAT(gathering.values(), ElementsAre(0.0, 0.1, 0.2, 0.3));
  EXPECT_EQ(gathering.begin().missing, 0u);
}

TEST(Gathering, AValueThatComesTwiceCountsOnceWithItsLastValue) {
  auto gathering = make(2);
  gathering.begin();
  EXPECT_FALSE(gathering.add(0, 1.0));
  EXPECT_FALSE(gathering.add(0, 2.0));
  EXPECT_TRUE(gathering.add(1, 3.0));
  EXPECT_THAT(gathering.values(), ElementsAre(2.0, 3.0));
}

TEST(Gathering, WhatComesBeforeTheFirstRoundCompletesNothing) {
  auto gathering = make(1);
  EXPECT_FALSE(gathering.add(0, 1.0));
  EXPECT_THAT(gathering.values(), ElementsAre(0.0));
  const auto round = gathering.begin();
  EXPECT_EQ(round.missing, 0u);
  EXPECT_FALSE(round.complete);
  EXPECT_TRUE(gathering.add(0, 2.0));
}

TEST(Gathering, NothingIsHeldForAMemberThatNeverAnswered) {
  auto gathering = make(2);
  gathering.begin();
  gathering.add(0, 1.0);
  EXPECT_EQ(gathering.begin().missing, 1u);
  EXPECT_EQ(gathering.missing_in_row(1), 1);
  EXPECT_FALSE(gathering.held(1));
  EXPECT_FALSE(gathering.add(0, 2.0));  // the zero of the other is no value
  EXPECT_TRUE(gathering.add(1, 3.0));
  EXPECT_THAT(gathering.values(), ElementsAre(2.0, 3.0));
}

TEST(Gathering, TheRoundAfterAMissingAnswerGoesOnWithTheLastValue) {
  auto gathering = make(2);
  complete_round(gathering, 1.0, 2.0);
  gathering.begin();
  EXPECT_FALSE(gathering.add(0, 3.0));
  const auto round = gathering.begin();
  EXPECT_EQ(round.missing, 1u);
  EXPECT_EQ(round.overdue, Gathering::kNobody);
  EXPECT_TRUE(gathering.held(1));
  EXPECT_TRUE(gathering.add(0, 4.0));
  EXPECT_THAT(gathering.values(), ElementsAre(4.0, 2.0));
}

TEST(Gathering, ALateAnswerIsNotTakenForThatOfTheNextRound) {
  auto gathering = make(2);
  complete_round(gathering, 1.0, 2.0);
  gathering.begin();
  gathering.add(0, 3.0);
  gathering.begin();
  EXPECT_FALSE(gathering.add(1, 2.5));  // that of the round before
  EXPECT_TRUE(gathering.add(0, 4.0));
  EXPECT_THAT(gathering.values(), ElementsAre(4.0, 2.0));
}

TEST(Gathering, AMemberThatShowedLifeIsWaitedForAgainInTheRoundAfter) {
  auto gathering = make(2);
  complete_round(gathering, 1.0, 2.0);
  gathering.begin();
  gathering.add(0, 3.0);
  gathering.begin();
  gathering.add(0, 4.0);
  gathering.add(1, 2.5);
  EXPECT_EQ(gathering.begin().missing, 0u);
  EXPECT_FALSE(gathering.add(0, 5.0));
  EXPECT_TRUE(gathering.add(1, 5.5));
  EXPECT_EQ(gathering.missing_in_row(1), 0);
  EXPECT_EQ(gathering.missing_ever(1), 1);
  // And what it said in between is what is held if it is missing again.
  gathering.begin();
  gathering.add(0, 6.0);
  gathering.begin();
  EXPECT_TRUE(gathering.add(0, 7.0));
  EXPECT_THAT(gathering.values(), ElementsAre(7.0, 5.5));
}

TEST(Gathering, WhatCameLateIsHeldIfTheMemberIsMissingAgain) {
  auto gathering = make(2);
  complete_round(gathering, 1.0, 2.0);
  gathering.begin();
  gathering.add(0, 3.0);
  gathering.begin();
  gathering.add(1, 2.5);
  gathering.add(0, 4.0);
  gathering.begin();
  gathering.add(0, 5.0);
  gathering.begin();
  EXPECT_TRUE(gathering.add(0, 6.0));
  EXPECT_THAT(gathering.values(), ElementsAre(6.0, 2.5));
}

TEST(Gathering, HalfAnAnswerIsNone) {
  auto gathering = make(2, 2);
  gathering.begin();
  for (const std::size_t member : {0u, 1u}) {
    for (const std::size_t place : {0u, 1u}) gathering.add(member, 1.0, place);
  }
  gathering.begin();
  gathering.add(0, 2.0);
  gathering.add(1, 2.0);
  gathering.add(0, 2.0, 1);
  EXPECT_EQ(gathering.begin().missing, 1u);
  EXPECT_EQ(gathering.missing_ever(1), 1);
  gathering.add(0, 3.0);
  EXPECT_TRUE(gathering.add(0, 3.0, 1));
  EXPECT_THAT(gathering.values(), ElementsAre(3.0, 1.0, 3.0, 1.0));
}

TEST(Gathering, IsCompleteAtOnceWhenAllAreHeld) {
  auto gathering = make(1);
  gathering.begin();
  gathering.add(0, 1.0);
  gathering.begin();
  const auto round = gathering.begin();
  EXPECT_TRUE(round.complete);
  EXPECT_FALSE(gathering.add(0, 2.0));
  EXPECT_THAT(gathering.values(), ElementsAre(1.0));
  EXPECT_FALSE(gathering.begin().complete);
  EXPECT_TRUE(gathering.add(0, 3.0));
}

TEST(Gathering, NamesTheFirstMemberThatIsMissingTooOften) {
  auto gathering = make(3, 1, 2);
  gathering.begin();
  for (std::size_t i = 0; i < 3; ++i) gathering.add(i, 1.0);
  gathering.begin();
  gathering.add(0, 1.0);
  EXPECT_EQ(gathering.begin().overdue, Gathering::kNobody);
  gathering.add(0, 1.0);
  const auto round = gathering.begin();
  EXPECT_EQ(round.missing, 2u);
  EXPECT_EQ(round.overdue, 1u);
  EXPECT_EQ(gathering.missing_in_row(2), 2);
}

TEST(Gathering, AMemberThatNeverAnswersIsNamedToo) {
  auto gathering = make(1, 1, 1);
  gathering.begin();
  EXPECT_EQ(gathering.begin().overdue, 0u);
}

TEST(Gathering, ResetForgetsValuesAndCounts) {
  auto gathering = make(2);
  complete_round(gathering, 1.0, 2.0);
  gathering.begin();
  gathering.begin();
  gathering.reset();
  EXPECT_THAT(gathering.values(), Each(0.0));
  EXPECT_EQ(gathering.missing_ever(0), 0);
  EXPECT_EQ(gathering.begin().missing, 0u);
  EXPECT_FALSE(gathering.held(0));
  EXPECT_FALSE(gathering.add(0, 3.0));
  EXPECT_TRUE(gathering.add(1, 4.0));
}

TEST(Gathering, NamesEveryFieldThatIsWrong) {
  const auto made = Gathering::make({.members = 0, .values_each = 0, .max_missing = 0});
  ASSERT_FALSE(made);
  EXPECT_THAT(made.error(), AllOf(HasSubstr("members is 0, expected at least 1"),
                                  HasSubstr("values_each is 0, expected at least 1"),
                                  HasSubstr("max_missing is 0, expected at least 1")));
}

}  // namespace
}  // namespace armature::control
