// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "armature/edit/internal/in_memory.hpp"

namespace armature::edit {
namespace {

using internal::edited;
using internal::Files;
using internal::refusal;

constexpr const char* kBlock = R"(components:
  Vision: {model: Camera}
  Prepare:
    model: Sequence
    activity: {periodic: 100 ms}
    calls:
      # the lens first
      - Vision.initialize  # takes a second
      - {call: Vision.setThreshold, with: {low: 10}}
      - Vision.start
)";

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

std::string with_calls(const std::string& calls) {
  return edited(kBlock, SetCalls{"Prepare", calls});
}

TEST(EditCalls, ReplacesTheOneThatDiffersAndKeepsTheOthersAsTheyAreWritten) {
  EXPECT_EQ(with_calls("[Vision.initialize, {call: Vision.setThreshold, with: {low: 20}}, "
                       "Vision.start]"),
            changed(kBlock, "low: 10", "low: 20"));
}

TEST(EditCalls, AddsInFrontBetweenAndBehind) {
  const std::string middle = "{call: Vision.setThreshold, with: {low: 10}}";
  EXPECT_EQ(with_calls("[Vision.wake, Vision.initialize, " + middle + ", Vision.start]"),
            changed(kBlock, "- Vision.initialize", "- Vision.wake\n      - Vision.initialize"));
  EXPECT_EQ(with_calls("[Vision.initialize, Vision.wait, " + middle + ", Vision.start]"),
            changed(kBlock, "a second\n", "a second\n      - Vision.wait\n"));
  EXPECT_EQ(with_calls("[Vision.initialize, " + middle + ", Vision.start, Vision.a, Vision.b]"),
            std::string(kBlock) + "      - Vision.a\n      - Vision.b\n");
}

TEST(EditCalls, RemovesOneAndAll) {
  EXPECT_EQ(with_calls("[Vision.initialize, Vision.start]"),
            changed(kBlock, "      - {call: Vision.setThreshold, with: {low: 10}}\n", ""));
  EXPECT_EQ(with_calls("[]").find("calls"), std::string::npos);
  EXPECT_NE(refusal("components: {A: {model: M}}\n", SetCalls{"A", "[]"}).find("has no calls"),
            std::string::npos);
}

TEST(EditCalls, ReadsItemsOfSeveralLines) {
  const std::string text =
      "components:\n  Go:\n    model: Sequence\n    calls:\n      - call: Eye.open\n"
      "        with: {far: 2 m}\n      - Eye.close\n  Eye: {model: Eye}\n";
  EXPECT_EQ(edited(text, SetCalls{"Go", "[{call: Eye.open, with: {far: 2 m}}, Eye.look]"}),
            changed(text, "Eye.close", "Eye.look"));
  EXPECT_EQ(edited(text, SetCalls{"Go", "[{call: Eye.open, with: {far: 3 m}}, Eye.close]"}),
            changed(text, "call: Eye.open\n        with: {far: 2 m}",
                    "{call: Eye.open, with: {far: 3 m}}"));
}

TEST(EditCalls, WritesTheFirstOnesAsNeighboursAre) {
  EXPECT_EQ(edited("components:\n  A: {model: Request, activity: triggered}\n  V: {model: M}\n",
                   SetCalls{"A", "V.distance"}),
            "components:\n  A: {model: Request, activity: triggered, calls: V.distance}\n"
            "  V: {model: M}\n");
  EXPECT_EQ(edited("components:\n  A:\n    model: Sequence\n  V: {model: M}\n",
                   SetCalls{"A", "[V.a, V.b]"}),
            "components:\n  A:\n    model: Sequence\n    calls:\n      - V.a\n      - V.b\n"
            "  V: {model: M}\n");
  EXPECT_EQ(edited("components:\n  A: {model: Sequence, calls: [V.a, V.c]}\n  V: {model: M}\n",
                   SetCalls{"A", "[V.a, V.b, V.c]"}),
            "components:\n  A: {model: Sequence, calls: [V.a, V.b, V.c]}\n  V: {model: M}\n");
}

TEST(EditCalls, OverridesWhatAnIncludedFileSays) {
  const Files files = {
      {"robot.yaml", "include: part.yaml\n"},
      {"part.yaml", "components:\n  A: {model: Sequence, calls: [V.a]}\n  V: {model: M}\n"}};
  EXPECT_EQ(edited(files, {SetCalls{"A", "[V.b]"}, {}, true}),
            "include: part.yaml\ncomponents:\n  A: {override: true, calls: [V.b]}\n");
  EXPECT_NE(refusal(files, SetCalls{"A", "[V.b]"}).find("stands in part.yaml"), std::string::npos);
}

TEST(EditCalls, RefusesWhatIsNoCall) {
  EXPECT_NE(refusal(kBlock, SetCalls{"Prepare", "[{cal: Vision.start}]"}).find("mistake"),
            std::string::npos);
  EXPECT_NE(refusal(kBlock, SetCalls{"Prepare", "start"}).find("expected Component.operation"),
            std::string::npos);
}

}  // namespace
}  // namespace armature::edit
