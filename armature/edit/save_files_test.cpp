// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/save_files.hpp"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "armature/platform/file.hpp"

namespace armature::edit {
namespace {

namespace fs = std::filesystem;

/// Two files in a folder of their own.
class SaveFiles : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    for (const char* name : {"a.yaml", "b.yaml"}) {
      ASSERT_TRUE(platform::write_file(path(name), "before").ok());
    }
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string text(const std::string& name) const {
    return platform::read_file(path(name)).value();
  }
  FileChange change(const std::string& name) const {
    return {path(name), "before", "after", {{0, 6, "after"}}, {{0, 5, "before"}}};
  }

 private:
  fs::path folder_ = fs::path(testing::TempDir()) / "armature_save_files_test";
};

TEST_F(SaveFiles, WritesAll) {
  ASSERT_TRUE(save_files({change("a.yaml"), change("b.yaml")}).ok());
  EXPECT_EQ(text("a.yaml"), "after");
  EXPECT_EQ(text("b.yaml"), "after");
}

TEST_F(SaveFiles, MakesTheFileOfWhatWasEmpty) {
  ASSERT_TRUE(save_files({{path("new.yaml"), "", "after", {{0, 0, "after"}}, {{0, 5, ""}}}}).ok());
  EXPECT_EQ(text("new.yaml"), "after");
}

TEST_F(SaveFiles, LeavesAllAloneWhenOneHasChangedMeanwhile) {
  ASSERT_TRUE(platform::write_file(path("b.yaml"), "by somebody else").ok());
  const auto saved = save_files({change("a.yaml"), change("b.yaml")});
  ASSERT_FALSE(saved.ok());
  EXPECT_EQ(saved.error(),
            "'" + path("b.yaml") +
                "' has changed while it was edited; nothing is written: edit it again");
  EXPECT_EQ(text("a.yaml"), "before");
  EXPECT_EQ(text("b.yaml"), "by somebody else");
}

TEST_F(SaveFiles, LeavesAllAloneWhenOneIsGone) {
  fs::remove(path("b.yaml"));
  EXPECT_FALSE(save_files({change("a.yaml"), change("b.yaml")}).ok());
  EXPECT_EQ(text("a.yaml"), "before");
  EXPECT_FALSE(fs::exists(path("b.yaml")));
}

}  // namespace
}  // namespace armature::edit
