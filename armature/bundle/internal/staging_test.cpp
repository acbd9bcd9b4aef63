// SPDX-License-Identifier: Apache-2.0
#include "armature/bundle/internal/staging.hpp"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/file.hpp"

namespace armature::bundle::internal {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class StagingTest : public ::testing::Test {
 protected:
  StagingTest() { fs::create_directory(folder_); }
  ~StagingTest() override { fs::remove_all(folder_); }

  std::string target() const { return (folder_ / "arm bundle").string(); }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }

  const fs::path folder_ = fs::path(::testing::TempDir()) / "staging_test";
};

TEST_F(StagingTest, LeavesNothingUnlessItIsHandedOver) {
  {
    Staging staging(target());
    ASSERT_TRUE(staging.make());
    ASSERT_TRUE(staging.write("lib/armature/libarm.so", "x", false));
    EXPECT_EQ(entries(), 1u);
  }
  EXPECT_EQ(entries(), 0u);
}

TEST_F(StagingTest, HandsOverAllAtOnce) {
  Staging staging(target());
  ASSERT_TRUE(staging.make());
  ASSERT_TRUE(staging.write("run", "#!/bin/sh\n", true));
  ASSERT_TRUE(staging.write("lib/libarm.so", "x", false));
  EXPECT_THAT(staging.places(), ElementsAre("lib/libarm.so", "run"));
  EXPECT_EQ(staging.size(), 11u);
  staging.set_times(1'000'000'000);
  ASSERT_TRUE(staging.hand_over(staging.folder()));
  EXPECT_EQ(entries(), 1u);
  EXPECT_EQ(fs::status(target() + "/run").permissions(), fs::perms(0755));
  EXPECT_EQ(fs::status(target() + "/lib/libarm.so").permissions(), fs::perms(0644));
  EXPECT_EQ(fs::last_write_time(target() + "/run"), fs::last_write_time(target() + "/lib"));
}

TEST_F(StagingTest, ReplacesWhatWasThereAsAWhole) {
  fs::create_directories(target() + "/old");
  Staging staging(target());
  ASSERT_TRUE(staging.make());
  ASSERT_TRUE(staging.write("run", "", true));
  ASSERT_TRUE(staging.hand_over(staging.folder()));
  EXPECT_FALSE(fs::exists(target() + "/old"));
  EXPECT_TRUE(fs::exists(target() + "/run"));
  EXPECT_EQ(entries(), 1u);
}

TEST_F(StagingTest, RefusesTheFolderOfAnother) {
  Staging staging(target());
  ASSERT_TRUE(staging.make());
  {
    Staging second(target());
    const auto made = second.make();
    ASSERT_FALSE(made);
    EXPECT_THAT(made.error(), HasSubstr("another bundle is being made, or was killed"));
  }
  EXPECT_TRUE(fs::exists(staging.folder()));
}

TEST_F(StagingTest, NamesAFolderThatIsMissing) {
  Staging staging((folder_ / "nowhere/arm").string());
  EXPECT_THAT(staging.make().error(), HasSubstr("nowhere' cannot be written: No such file"));
}

}  // namespace
}  // namespace armature::bundle::internal
