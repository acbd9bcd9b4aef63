// SPDX-License-Identifier: Apache-2.0
#include "armature/report/goals.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::report {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr const char* kReport =
    R"({"io": {"arm": {"computing_us": 4.5, "wire_us": 9}, "no": null}})";

std::vector<Goal> good(const std::string& goals) {
  base::Diagnostics diagnostics;
  auto parsed = parse_goals(R"({"to_reach": [)" + goals + "]}", "goals.json", diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.to_text();
  return parsed;
}

Reached reached(const std::string& goal) { return look_up(good(goal).at(0), kReport); }

TEST(Goals, AreReachedUpToTheirBound) {
  const auto most = [](const char* bound) {
    return reached(R"({"name": "n", "figure": "/io/arm/computing_us", "most": )" +
                   std::string(bound) + "}");
  };
  EXPECT_EQ(most("5").value, 4.5);
  EXPECT_TRUE(most("5").reached);
  EXPECT_TRUE(most("4.5").reached);
  EXPECT_FALSE(most("4.4").reached);
  EXPECT_TRUE(reached(R"({"name": "n", "figure": "/io/arm/wire_us", "least": 9})").reached);
  EXPECT_FALSE(reached(R"({"name": "n", "figure": "/io/arm/wire_us", "least": 10})").reached);
}

TEST(Goals, MayBeOfOneFigureOverAnother) {
  const auto found = reached(
      R"({"name": "n", "figure": "/io/arm/wire_us", "over": "/io/arm/computing_us", "least": 2})");
  EXPECT_EQ(found.value, 2.0);
  EXPECT_TRUE(found.reached);
}

TEST(Goals, AreNotReachedByWhatIsNotThere) {
  for (const char* goal :
       {R"({"name": "n", "figure": "/io/leg/wire_us", "most": 1})",
        R"({"name": "n", "figure": "/io/no", "most": 1})",
        R"({"name": "n", "figure": "/io/arm/wire_us", "over": "/x", "most": 99})"}) {
    EXPECT_FALSE(reached(goal).value) << goal;
    EXPECT_FALSE(reached(goal).reached) << goal;
  }
}

TEST(Goals, NoTextHasNone) {
  base::Diagnostics diagnostics;
  EXPECT_THAT(parse_goals("", "goals.json", diagnostics), SizeIs(0));
  EXPECT_TRUE(diagnostics.ok());
}

TEST(Goals, EveryMistakeIsToldWithItsGoal) {
  base::Diagnostics diagnostics;
  parse_goals(R"({"to_reach": [{"figure": "/a", "most": 1}, {"name": "b", "figure": "a", "most": 1},
                 {"name": "c", "figure": "/a"}, {"name": "d", "figure": "/a", "over": "x", "most": 1},
                 {"name": "e", "figure": "/a", "most": 1, "least": 1}]})",
              "goals.json", diagnostics);
  const std::string told = diagnostics.to_text();
  EXPECT_THAT(told, HasSubstr("goals.json"));
  EXPECT_THAT(told, HasSubstr("goal 1, '', has no name"));
  EXPECT_THAT(told, HasSubstr("goal 2, 'b', has the figure 'a', expected where it is"));
  EXPECT_THAT(told, HasSubstr("goal 3, 'c', needs a number, most or least"));
  EXPECT_THAT(told, HasSubstr("goal 4, 'd', is over 'x', expected where that is"));
  EXPECT_THAT(told, HasSubstr("goal 5, 'e', needs a number, most or least"));
}

TEST(Goals, ADocumentOfSomethingElseIsRefused) {
  base::Diagnostics diagnostics;
  parse_goals(R"({"goals": []})", "goals.json", diagnostics);
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("expected an object with a list `to_reach`"));
}

}  // namespace
}  // namespace armature::report
