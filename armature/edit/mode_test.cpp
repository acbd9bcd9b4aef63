// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "armature/edit/internal/in_memory.hpp"

namespace armature::edit {
namespace {

using internal::edited;
using internal::Files;
using internal::refusal;

constexpr const char* kModes = R"(components:
  A: {model: M}
  B{1..2}: {model: M}
  C: {model: M}
modes:
  one: [A, "B{1..2}"]  # at first
  two: C
mode: one
)";

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(EditMode, AddsAComponent) {
  EXPECT_EQ(edited(kModes, AddToMode{"one", "C"}), changed(kModes, "2}\"]", "2}\", C]"));
  EXPECT_EQ(edited(kModes, AddToMode{"two", "B{1..2}"}),
            changed(kModes, "two: C", "two: [C, \"B{1..2}\"]"));
}

TEST(EditMode, MakesAModeOfItsFirstComponent) {
  EXPECT_EQ(edited(kModes, AddToMode{"three", "A"}),
            changed(kModes, "two: C\n", "two: C\n  three: [A]\n"));
  EXPECT_EQ(edited("components:\n  A: {model: M}\n", AddToMode{"only", "A"}),
            "components:\n  A: {model: M}\nmodes:\n  only: [A]\n");
}

TEST(EditMode, RemovesAComponentAndWarnsOfWhatRunsInAllModesThen) {
  EXPECT_EQ(edited(kModes, RemoveFromMode{"one", "B{1..2}"}), changed(kModes, ", \"B{1..2}\"", ""));
  const Outcome outcome = internal::outcome_of(kModes, {{RemoveFromMode{"one", "A"}}});
  EXPECT_NE(outcome.diagnostics.to_text().find("warning: 'A' is in no mode then, and runs in all"),
            std::string::npos)
      << outcome.diagnostics.to_text();
}

TEST(EditMode, RemovesAModeAlsoWhereTheApplicationStartsInIt) {
  EXPECT_EQ(edited(kModes, RemoveMode{"two"}), changed(kModes, "  two: C\n", ""));
  EXPECT_EQ(
      edited(kModes, RemoveMode{"one"}),
      changed(changed(kModes, "  one: [A, \"B{1..2}\"]  # at first\n", ""), "mode: one\n", ""));
}

TEST(EditMode, IsRenamedAlsoWhereTheApplicationStartsInIt) {
  EXPECT_EQ(edited(kModes, RenameMode{"one", "first"}),
            changed(changed(kModes, "  one:", "  first:"), "mode: one", "mode: first"));
}

TEST(EditMode, HasTheApplicationStartInIt) {
  EXPECT_EQ(edited(kModes, StartInMode{"two"}), changed(kModes, "mode: one", "mode: two"));
  const std::string silent = changed(kModes, "mode: one\n", "");
  EXPECT_EQ(edited(silent, StartInMode{"two"}), silent + "mode: two\n");
  EXPECT_EQ(edited(silent, StartInMode{"one"}), kModes) << "the first one, now in words";
}

TEST(EditMode, OfTheStartThatAnIncludedFileSaysIsChangedThereOrOverridden) {
  const Files files = {{"robot.yaml", "include: arm.yaml\n"}, {"arm.yaml", kModes}};
  EXPECT_NE(refusal(files, StartInMode{"two"}).find("--in arm.yaml"), std::string::npos);
  const Outcome there = internal::outcome_of(files, {{StartInMode{"two"}, {"arm.yaml"}}});
  ASSERT_EQ(there.files.size(), 1u) << there.diagnostics.to_text();
  EXPECT_EQ(there.files[0].after, changed(kModes, "mode: one", "mode: two"));
  const Outcome here = internal::outcome_of(files, {{StartInMode{"two"}, {}, true}});
  ASSERT_EQ(here.files.size(), 1u) << here.diagnostics.to_text();
  EXPECT_EQ(here.files[0].after, "include: arm.yaml\nmode: two\n");
}

TEST(EditMode, RefusesWhatIsNotThereOrStandsForOthers) {
  const auto reason = [](const Change& change) {
    return refusal(Files{{"robot.yaml", kModes}}, change);
  };
  EXPECT_NE(reason(AddToMode{"one", "B1"}).find("'B1' is in it already"), std::string::npos);
  EXPECT_NE(reason(AddToMode{"a b", "C"}).find("not a valid name"), std::string::npos);
  EXPECT_NE(reason(RemoveFromMode{"one", "B1"}).find("stands there for others, too"),
            std::string::npos);
  EXPECT_NE(reason(RemoveFromMode{"one", "C"}).find("does not name it"), std::string::npos);
  EXPECT_NE(reason(RemoveFromMode{"two", "C"}).find("would have no component"), std::string::npos);
  EXPECT_NE(reason(RemoveMode{"tow"}).find("did you mean 'two'"), std::string::npos);
  EXPECT_NE(reason(RenameMode{"one", "two"}).find("is there already"), std::string::npos);
  EXPECT_NE(reason(StartInMode{"tow"}).find("did you mean 'two'"), std::string::npos);
  EXPECT_NE(reason(StartInMode{"one"}).find("starts in 'one' already"), std::string::npos);
  EXPECT_NE(reason(RenameMode{"one", "{i}"}).find("not a valid name"), std::string::npos);
}

TEST(EditMode, OfAnIncludedFileChangesOnlyWhenItMay) {
  const Files files = {{"robot.yaml", "include: arm.yaml\n"}, {"arm.yaml", kModes}};
  EXPECT_NE(refusal(files, AddToMode{"one", "C"}).find("--in arm.yaml"), std::string::npos);
  EXPECT_TRUE(internal::outcome_of(files, {{AddToMode{"one", "C"}, {"arm.yaml"}}}).ok());
}

}  // namespace
}  // namespace armature::edit
