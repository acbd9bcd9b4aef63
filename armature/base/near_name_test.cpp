// SPDX-License-Identifier: Apache-2.0
#include "armature/base/near_name.hpp"

#include <gtest/gtest.h>

namespace armature::base {
namespace {

const std::vector<std::string> kPorts{"reference", "position", "velocity", "act"};

TEST(NearName, FindsANameWithOneWrongLetter) {
  EXPECT_EQ(near_name("positoin", kPorts), "position");
  EXPECT_EQ(near_name("velocty", kPorts), "velocity");
  EXPECT_EQ(near_name("referencee", kPorts), "reference");
}

TEST(NearName, IgnoresCase) { EXPECT_EQ(near_name("POSITION", kPorts), "position"); }

TEST(NearName, PrefersTheNearest) {
  EXPECT_EQ(near_name("joint2", {"joint1", "joint2", "joint3"}), "joint2");
}

TEST(NearName, CountsTwoSwappedLettersOnce) { EXPECT_EQ(near_name("atc", kPorts), "act"); }

TEST(NearName, IsEmptyIfMoreThanAThirdOfTheLettersDiffer) {
  EXPECT_EQ(near_name("torque", kPorts), "");
  EXPECT_EQ(near_name("pos", kPorts), "");
}

TEST(NearName, IsEmptyWithoutCandidates) { EXPECT_EQ(near_name("act", {}), ""); }

TEST(NearName, AcceptsAnEmptyName) { EXPECT_EQ(near_name("", kPorts), ""); }

TEST(Suggestion, AsksForTheNearName) {
  const Hint hint = suggestion("positon", kPorts);
  EXPECT_EQ(hint.text, "did you mean 'position'?");
  EXPECT_EQ(hint.fix, (Replacement{"positon", "position"}));
}

TEST(Suggestion, ListsAFewKnownNames) {
  const Hint hint = suggestion("torque", kPorts);
  EXPECT_EQ(hint.fix, std::nullopt);
  EXPECT_EQ(hint.text, "known: reference, position, velocity, act");
}

TEST(Suggestion, SaysNothingRatherThanListManyNames) {
  const std::vector<std::string> nine(9, "reference");
  EXPECT_EQ(suggestion("torque", nine).text, "");
  EXPECT_EQ(suggestion("torque", {}).text, "");
  EXPECT_EQ(suggestion_in_brackets("torque", nine), "");
}

TEST(Suggestion, StandsInBracketsAtTheEndOfAMessage) {
  EXPECT_EQ(suggestion_in_brackets("refrence", {"reference"}), " (did you mean 'reference'?)");
}

}  // namespace
}  // namespace armature::base
