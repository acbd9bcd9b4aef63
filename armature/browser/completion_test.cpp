// SPDX-License-Identifier: Apache-2.0
// Which words the task browser offers where the cursor is.
#include "armature/browser/internal/test_screen.hpp"

namespace armature::browser::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

struct Case {
  const char* before_cursor;
  std::vector<std::string> words;
};

class Completing : public ::testing::TestWithParam<Case> {};

TEST_P(Completing, OffersTheseWords) {
  Desk desk;
  EXPECT_EQ(desk.browser.complete(GetParam().before_cursor).words, GetParam().words);
}

INSTANTIATE_TEST_SUITE_P(
    Each, Completing,
    ::testing::Values(
        Case{"Ax", {"Axis"}}, Case{"thr", {"threads"}}, Case{"  wat", {"watch"}},
        Case{"print(Ax", {"Axis"}}, Case{"Axis.", {"Axis.Both", "Axis.Position"}},
        Case{"Axis:", {"Axis:arm(", "Axis:moveTo("}}, Case{"x = Axis:mo", {"Axis:moveTo("}},
        Case{"left.", {"left.hand"}}, Case{"left.hand.F", {"left.hand.Finger"}},
        Case{"left.hand.Finger.Of", {"left.hand.Finger.Offsets"}}, Case{"ai", {"_G[\"aic-1\"]"}},
        Case{"_G[\"ai", {"_G[\"aic-1\"]"}}, Case{"_G[\"aic-1\"].Of", {"_G[\"aic-1\"].Offsets"}},
        Case{"stop le", {"left.hand.Finger"}}, Case{"ls A", {"Axis"}},
        Case{"watch Axis.P", {"Axis.Position"}}, Case{"watch ev", {"every"}},
        Case{"help wat", {"watch"}},
        Case{"help Axis.", {"Axis.Both", "Axis.Position", "Axis.arm", "Axis.moveTo"}},
        Case{"math.fl", {"math.floor"}}, Case{"Nobody.", {}}, Case{"motion:c", {"motion:cancel()"}},
        Case{"Axis.Position + Se", {"Settings"}}));

TEST(Completion, BeginsWithTheWordAtTheCursor) {
  Desk desk;
  EXPECT_EQ(desk.browser.complete("print(Settings.G").begin, 6u);
  EXPECT_EQ(desk.browser.complete("print(Settings.G").common(), "Settings.Gain");
  EXPECT_EQ(desk.browser.complete("nothing.at.all").common(), "");
}

TEST(Completion, KnowsTheOperatorsOwnVariables) {
  Desk desk;
  desk.type("velocity = 3");
  EXPECT_THAT(desk.browser.complete("velo").words, ElementsAre("velocity"));
}

TEST(Completion, OffersCommandsOnlyAtTheBegin) {
  Desk desk;
  EXPECT_THAT(desk.browser.complete("").words, Contains("threads"));
  EXPECT_THAT(desk.browser.complete("x = ").words, Not(Contains("threads")));
  EXPECT_THAT(desk.browser.complete("start thr").words, IsEmpty());
}

}  // namespace
}  // namespace armature::browser::test
