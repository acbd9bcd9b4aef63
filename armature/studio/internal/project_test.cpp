// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/project.hpp"

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/document/limits.hpp"

namespace armature::studio::internal {
namespace {

using ::testing::HasSubstr;
using ::testing::Key;
using ::testing::UnorderedElementsAre;

constexpr const char* kMain =
    "application: arm\n"
    "include: [parts.yaml]\n"
    "components:\n"
    "  Left: {model: Gain}   # the left one\n";
constexpr const char* kParts = "components:\n  Right: {model: Gain}\n";

/// A deployment of two files, and a disk that others may write to.
struct Edited : ::testing::Test {
  Project::Disk on_disk() {
    return {[this](const std::string& path) -> base::Result<std::string> {
              const auto found = disk.find(path);
              return found == disk.end() ? std::string() : found->second;
            },
            [this](const std::vector<edit::FileChange>& files) -> base::Result<void> {
              for (const auto& file : files) {
                if (disk[file.file] != file.before) return base::Error{file.file + " has changed"};
              }
              for (const auto& file : files) disk[file.file] = file.after;
              return {};
            }};
  }
  std::string make(const std::string& name, std::vector<std::string> words,
                   const std::vector<std::string>& files = {}) {
    return project.edit({{name, std::move(words)}}, files, false).to_text();
  }
  const std::string& text(const std::string& path = "arm.yaml") { return *project.text(path); }

  std::map<std::string, std::string> disk{{"arm.yaml", kMain}, {"parts.yaml", kParts}};
  Project project{"arm.yaml", on_disk()};
};

TEST_F(Edited, HasTheFilesOfTheDeployment) {
  EXPECT_THAT(project.files(), UnorderedElementsAre(Key("arm.yaml"), Key("parts.yaml"),
                                                    Key("arm.yaml.studio.json")));
  EXPECT_TRUE(project.is_saved());
}

TEST_F(Edited, AnEditKeepsTheTextAndIsTakenBackAndDoneAgain) {
  EXPECT_EQ(make("add", {"Third", "Gain"}), "");
  const std::string edited = text();
  EXPECT_THAT(edited, HasSubstr("# the left one\n  Third: {model: Gain}"));
  EXPECT_EQ(project.undo_text(), "add Third");
  EXPECT_EQ(project.version(), 2);
  EXPECT_TRUE(project.undo());
  EXPECT_EQ(text(), kMain);
  EXPECT_EQ(project.redo_text(), "add Third");
  EXPECT_TRUE(project.redo());
  EXPECT_EQ(text(), edited);
  EXPECT_EQ(disk["arm.yaml"], kMain) << "nothing is written before it is saved";
}

TEST_F(Edited, WhatIsRefusedChangesNothing) {
  EXPECT_THAT(make("remove", {"Nobody"}), HasSubstr("Nobody"));
  EXPECT_THAT(make("add", {"Third"}), HasSubstr("the edit 'add' takes 2 words, not 1"));
  EXPECT_THAT(make("ad", {"Third", "Gain"}), HasSubstr("did you mean 'add'?"));
  EXPECT_THAT(make("place", {"Left"}), HasSubstr("takes a box, x and y"));
  EXPECT_EQ(project.version(), 1);
  EXPECT_FALSE(project.undo());
  EXPECT_FALSE(project.redo());
}

TEST_F(Edited, BoxesAreMovedAsTheSameKindOfStep) {
  EXPECT_EQ(make("place", {"Left", "100", "50"}), "");
  EXPECT_THAT(text(project.places_file()), HasSubstr("\"Left\": [104, 48]"));
  EXPECT_EQ(make("rename", {"Left", "Only"}), "");
  EXPECT_THAT(text(project.places_file()), HasSubstr("\"Only\": [104, 48]"));
  EXPECT_THAT(text(), HasSubstr("Only: {model: Gain}"));
  EXPECT_TRUE(project.undo());
  EXPECT_THAT(text(project.places_file()), HasSubstr("\"Left\""));
  EXPECT_TRUE(project.undo());
  EXPECT_EQ(text(project.places_file()), "");
}

TEST_F(Edited, WhatMovesARobotIsKeptBesidePlaces) {
  EXPECT_EQ(make("robot", {"Left", "Right.Positions"}), "");
  EXPECT_THAT(text(project.places_file()), HasSubstr("\"Left\": \"Right.Positions\""));
  EXPECT_EQ(project.undo_text(), "choose what moves Left");
  EXPECT_EQ(make("rename", {"Left", "Only"}), "");
  EXPECT_THAT(text(project.places_file()), HasSubstr("\"Only\": \"Right.Positions\""));
  EXPECT_THAT(make("robot", {"Only"}), HasSubstr("takes a component and a port"));
  EXPECT_TRUE(project.undo());
  EXPECT_TRUE(project.undo());
  EXPECT_EQ(text(project.places_file()), "");
}

TEST_F(Edited, PartsOfAGroupKeepTheirPlaces) {
  EXPECT_EQ(make("place", {"Left", "100", "50"}), "");
  EXPECT_EQ(make("group", {"Whole", "Left"}), "");
  EXPECT_THAT(text(), HasSubstr("Whole: {model: Whole"));
  EXPECT_THAT(text(project.places_file()), HasSubstr("\"Whole.Left\": [104, 48]"));
  EXPECT_EQ(make("dissolve", {"Whole"}), "");
  EXPECT_THAT(text(project.places_file()), HasSubstr("\"Left\": [104, 48]"));
  EXPECT_THAT(make("group", {"Whole"}), HasSubstr("takes 2 to 1001 words, not 1"));
  EXPECT_THAT(make("split", {"Left", "1"}), HasSubstr("'Left' is no range"));
}

TEST_F(Edited, PlacesThatAreNoneStopNoEditOfTheDeployment) {
  disk["arm.yaml.studio.json"] = "broken";
  project.reload();
  EXPECT_EQ(make("rename", {"Left", "Only"}), "");
  EXPECT_THAT(make("place", {"Only", "1", "1"}), HasSubstr("arm.yaml.studio.json"));
  EXPECT_EQ(text(project.places_file()), "broken");
}

TEST_F(Edited, AnIncludedFileChangesWhereItMay) {
  EXPECT_NE(make("set", {"Right.Factor", "2"}), "");
  EXPECT_EQ(make("set", {"Right.Factor", "2"}, {"parts.yaml"}), "");
  EXPECT_THAT(text("parts.yaml"), HasSubstr("Factor: 2"));
  EXPECT_TRUE(project.save());
  EXPECT_THAT(disk["parts.yaml"], HasSubstr("Factor: 2"));
  EXPECT_EQ(disk["arm.yaml"], kMain);
}

TEST_F(Edited, WhatIsTypedIsMergedWithWhatOthersDid) {
  const std::int32_t version = project.version();
  EXPECT_EQ(make("add", {"Third", "Gain"}), "");
  std::string typed = kMain;
  typed.replace(typed.find(" arm\n"), 5, " robot\n");
  EXPECT_TRUE(project.write(version, "arm.yaml", typed));
  EXPECT_THAT(text(), HasSubstr("application: robot\n"));
  EXPECT_THAT(text(), HasSubstr("Third: {model: Gain}"));
  EXPECT_TRUE(project.undo());
  EXPECT_THAT(text(), HasSubstr("application: arm\n"));
  EXPECT_THAT(text(), HasSubstr("Third: {model: Gain}"));
}

TEST_F(Edited, TwoWhoTypeAtTheSamePlaceAreToldApart) {
  std::string mine = kMain;
  mine.replace(mine.find(" arm\n"), 5, " robot\n");
  std::string theirs = kMain;
  theirs.replace(theirs.find(" arm\n"), 5, " machine\n");
  EXPECT_TRUE(project.write(1, "arm.yaml", theirs));
  const auto refused = project.write(1, "arm.yaml", mine);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error(), HasSubstr("others changed the same place of 'arm.yaml'"));
  EXPECT_EQ(text(), theirs);
  EXPECT_FALSE(project.write(1, "elsewhere.yaml", mine));
  EXPECT_FALSE(project.write(99, "arm.yaml", mine));
}

TEST_F(Edited, ATextOfLongAgoIsMergedAsLongAsItsVersionIsKnown) {
  for (int i = 0; i < 1200; ++i) EXPECT_EQ(make("place", {"Left", std::to_string(8 * i), "0"}), "");
  std::string typed = kMain;
  typed.replace(typed.find(" arm\n"), 5, " robot\n");
  EXPECT_FALSE(project.write(1, "arm.yaml", typed)) << "a thousand versions are known";
  EXPECT_TRUE(project.write(project.version() - 1000, "arm.yaml", typed));
  EXPECT_EQ(text(), typed);
  int steps = 0;
  while (project.undo()) ++steps;
  EXPECT_EQ(steps, 1000);
}

TEST_F(Edited, ATextThatNoFileMayHoldIsRefused) {
  EXPECT_FALSE(project.write(1, "arm.yaml", std::string(document::Limits{}.file_bytes + 1, ' ')));
  EXPECT_EQ(text(), kMain);
}

TEST_F(Edited, AFileWithMistakesIsMendedAsText) {
  EXPECT_TRUE(project.write(1, "arm.yaml", "components: {A: [\n"));
  EXPECT_NE(make("add", {"Third", "Gain"}), "");
  EXPECT_TRUE(project.write(2, "arm.yaml", kMain));
  EXPECT_EQ(make("add", {"Third", "Gain"}), "");
}

TEST_F(Edited, AFileThatIsIncludedFromNowOnIsThere) {
  disk["more.yaml"] = "components: {}\n";
  std::string text = kMain;
  text.replace(text.find("parts.yaml]"), 11, "parts.yaml, more.yaml]");
  EXPECT_TRUE(project.write(1, "arm.yaml", text));
  EXPECT_NE(project.text("more.yaml"), nullptr);
  EXPECT_TRUE(project.undo());
  EXPECT_EQ(project.text("more.yaml"), nullptr);
}

TEST_F(Edited, WhatOthersWriteToTheDiskIsTakenOver) {
  EXPECT_EQ(make("add", {"Third", "Gain"}), "");
  disk["arm.yaml"].replace(disk["arm.yaml"].find(" arm\n"), 5, " robot\n");
  EXPECT_THAT(project.take_from_disk(), HasSubstr("others changed arm.yaml: it is taken over"));
  EXPECT_THAT(text(), HasSubstr("application: robot\n"));
  EXPECT_THAT(text(), HasSubstr("Third: {model: Gain}"));
  EXPECT_EQ(project.take_from_disk(), "");
  EXPECT_TRUE(project.save());
  EXPECT_THAT(disk["arm.yaml"], HasSubstr("Third"));
  EXPECT_TRUE(project.is_saved());
}

TEST_F(Edited, WhatBothChangedIsNotSavedAndNeitherIsLost) {
  std::string mine = kMain;
  mine.replace(mine.find(" arm\n"), 5, " robot\n");
  EXPECT_TRUE(project.write(1, "arm.yaml", mine));
  std::string theirs = kMain;
  theirs.replace(theirs.find(" arm\n"), 5, " machine\n");
  disk["arm.yaml"] = theirs;
  EXPECT_THAT(project.take_from_disk(), HasSubstr("where you did, too: it cannot be saved"));
  EXPECT_EQ(project.take_from_disk(), "") << "it is told once";
  EXPECT_FALSE(project.save());
  EXPECT_EQ(disk["arm.yaml"], theirs);
  project.reload();
  EXPECT_EQ(text(), theirs);
  EXPECT_TRUE(project.undo());
  EXPECT_EQ(text(), mine);
  EXPECT_TRUE(project.save());
  EXPECT_EQ(disk["arm.yaml"], mine);
}

TEST_F(Edited, WhatWasNotSavedIsRestored) {
  EXPECT_EQ(make("add", {"Third", "Gain"}), "");
  const Unsaved kept = project.unsaved();
  Project later("arm.yaml", on_disk());
  EXPECT_THAT(later.restore(kept), HasSubstr("is here again"));
  EXPECT_EQ(*later.text("arm.yaml"), text());
  EXPECT_TRUE(later.undo());
  EXPECT_TRUE(later.is_saved());
  EXPECT_EQ(later.restore({}), "");
}

TEST_F(Edited, WhatOthersChangedMeanwhileIsInWhatIsRestored) {
  EXPECT_EQ(make("add", {"Third", "Gain"}), "");
  const Unsaved kept = project.unsaved();
  disk["arm.yaml"].replace(disk["arm.yaml"].find(" arm\n"), 5, " robot\n");
  Project later("arm.yaml", on_disk());
  EXPECT_THAT(later.restore(kept), HasSubstr("others changed arm.yaml"));
  EXPECT_THAT(*later.text("arm.yaml"), HasSubstr("application: robot\n"));
  EXPECT_THAT(*later.text("arm.yaml"), HasSubstr("Third"));
}

TEST(NewProject, BeginsWithNothingAndIsSaved) {
  std::map<std::string, std::string> disk;
  Project project("new.yaml",
                  {[&](const std::string& path) -> base::Result<std::string> { return disk[path]; },
                   [&](const std::vector<edit::FileChange>& files) -> base::Result<void> {
                     for (const auto& file : files) disk[file.file] = file.after;
                     return {};
                   }});
  EXPECT_EQ(project.edit({{"add", {"A", "Gain"}}}, {}, false).to_text(), "");
  EXPECT_TRUE(project.save());
  EXPECT_THAT(disk["new.yaml"], HasSubstr("A: {model: Gain}"));
}

}  // namespace
}  // namespace armature::studio::internal
