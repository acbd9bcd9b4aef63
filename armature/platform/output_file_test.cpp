// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/output_file.hpp"

#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/file.hpp"

namespace armature::platform {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(OutputFile, HoldsAtOnceWhatWasWritten) {
  const std::string path = testing::TempDir() + "/output_file_growing";
  auto file = OutputFile::create(path);
  ASSERT_TRUE(file);
  ASSERT_TRUE(file.value().write("one "));
  EXPECT_EQ(read_file(path).value(), "one ");
  ASSERT_TRUE(file.value().write("two"));
  EXPECT_EQ(read_file(path).value(), "one two");
}

TEST(OutputFile, EmptiesTheFileThatIsThere) {
  const std::string path = testing::TempDir() + "/output_file_old";
  ASSERT_TRUE(write_file(path, "old"));
  ASSERT_TRUE(OutputFile::create(path));
  EXPECT_EQ(read_file(path).value(), "");
}

TEST(OutputFile, MovesToAnotherOwner) {
  const std::string path = testing::TempDir() + "/output_file_moved";
  auto created = OutputFile::create(path);
  OutputFile file = std::move(created).value();
  ASSERT_TRUE(file.write("content"));
  EXPECT_TRUE(file.close());
  EXPECT_TRUE(file.close());
  EXPECT_EQ(read_file(path).value(), "content");
}

TEST(OutputFile, SaysWhatCannotBeMade) {
  EXPECT_THAT(OutputFile::create("/no/such/folder/file").error(),
              AllOf(HasSubstr("/no/such/folder/file"), HasSubstr("No such file or directory")));
}

TEST(OutputFile, SaysThatTheDiskIsFull) {
  auto file = OutputFile::create("/dev/full");
  ASSERT_TRUE(file);
  EXPECT_EQ(file.value().write("more").error(),
            "cannot write '/dev/full': No space left on device");
}

TEST(OutputFile, RefusesToWriteOnceItIsClosed) {
  auto file = OutputFile::create(testing::TempDir() + "/output_file_closed");
  ASSERT_TRUE(file.value().close());
  EXPECT_THAT(file.value().write("more").error(), HasSubstr("Bad file descriptor"));
}

TEST(OutputFile, OfAnotherWriterIsLeftAlone) {
  const std::string path = testing::TempDir() + "/output_file_of_two";
  auto first = OutputFile::create(path);
  ASSERT_TRUE(first.value().write("first"));
  EXPECT_EQ(OutputFile::create(path).error(),
            "cannot write '" + path + "': another process writes it");
  EXPECT_EQ(read_file(path).value(), "first");
  ASSERT_TRUE(first.value().close());
  EXPECT_TRUE(OutputFile::create(path));
}

TEST(OutputFile, TakesBackItsEnd) {
  const std::string path = testing::TempDir() + "/output_file_end";
  auto file = OutputFile::create(path);
  ASSERT_TRUE(file.value().write("whole part"));
  EXPECT_EQ(file.value().size(), 10u);
  file.value().truncate(5);
  ASSERT_TRUE(file.value().write("!"));
  EXPECT_EQ(read_file(path).value(), "whole!");
}

}  // namespace
}  // namespace armature::platform
