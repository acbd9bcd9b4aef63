// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/file.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace armature::platform {
namespace {

namespace fs = std::filesystem;
using ::testing::UnorderedElementsAre;

/// A directory of its own for each test.
class File : public ::testing::Test {
 protected:
  File() {
    char name[] = "/tmp/armature_file_test_XXXXXX";
    directory_ = ::mkdtemp(name);
  }
  ~File() override { fs::remove_all(directory_); }

  std::string path(const std::string& name) const { return directory_ + "/" + name; }
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(directory_)) {
      found.push_back(entry.path().filename());
    }
    return found;
  }

  std::string directory_;
};

TEST_F(File, ReadsWhatWasWritten) {
  std::string content = "first\0second\n";
  content += std::string(100000, 'x');
  ASSERT_TRUE(write_file(path("a"), content).ok());
  EXPECT_EQ(read_file(path("a")).value(), content);
  ASSERT_TRUE(write_file(path("a"), "").ok());
  EXPECT_EQ(read_file(path("a")).value(), "");
  EXPECT_THAT(names(), UnorderedElementsAre("a"));
}

TEST_F(File, ReadingWhatIsNotThereNamesThePath) {
  EXPECT_EQ(read_file(path("none")).error(),
            "cannot read '" + path("none") + "': No such file or directory");
}

TEST_F(File, ReadingADirectoryIsAnError) {
  EXPECT_EQ(read_file(directory_).error(), "cannot read '" + directory_ + "': Is a directory");
}

TEST_F(File, APipeOrADeviceIsNoFileAndNobodyWaitsForIt) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_EQ(read_file(path("pipe")).error(),
            "cannot read '" + path("pipe") + "': it is a pipe, and a file is expected");
  EXPECT_EQ(expect_file(path("pipe")).error(), read_file(path("pipe")).error());
  EXPECT_EQ(read_file("/dev/zero").error(),
            "cannot read '/dev/zero': it is a device, and a file is expected");
  EXPECT_FALSE(expect_file(path("none")));
  ASSERT_TRUE(write_file(path("a"), "x"));
  EXPECT_TRUE(expect_file(path("a")));
}

TEST_F(File, IsTheSameByWhateverLinks) {
  ASSERT_TRUE(write_file(path("a"), "x"));
  ASSERT_TRUE(write_file(path("b"), "x"));
  fs::create_symlink(path("a"), path("soft"));
  fs::create_hard_link(path("a"), path("hard"));
  EXPECT_TRUE(is_same_file(path("a"), directory_ + "/./a"));
  EXPECT_TRUE(is_same_file(path("a"), path("soft")));
  EXPECT_TRUE(is_same_file(path("hard"), path("soft")));
  EXPECT_FALSE(is_same_file(path("a"), path("b")));
  EXPECT_FALSE(is_same_file(path("none"), path("none")));
}

TEST_F(File, WhetherItCanBeWrittenIsToldBefore) {
  EXPECT_TRUE(expect_writable(path("new")));
  EXPECT_FALSE(fs::exists(path("new")));
  EXPECT_EQ(expect_writable(path("none/a")).error(),
            "cannot write '" + path("none/a") + "': No such file or directory");
  EXPECT_FALSE(expect_writable(directory_));
}

TEST_F(File, AFolderIsLockedByOneAtATime) {
  {
    const auto lock = FolderLock::take(directory_);
    ASSERT_TRUE(lock);
    EXPECT_EQ(FolderLock::take(directory_).error(), "the folder '" + directory_ +
                                                        "' is used by another run, process " +
                                                        std::to_string(::getpid()));
  }
  EXPECT_TRUE(FolderLock::take(directory_)) << "it ends with its object";
  EXPECT_TRUE(fs::is_empty(directory_)) << "and leaves nothing";
  EXPECT_FALSE(FolderLock::take(path("none")));
}

TEST_F(File, ReadingStopsAtTheLimit) {
  ASSERT_TRUE(write_file(path("a"), "12345678901").ok());
  EXPECT_EQ(read_file(path("a"), 10).error(),
            "cannot read '" + path("a") + "': it is larger than 10 bytes");
  EXPECT_EQ(read_file(path("a"), 11).value(), "12345678901");
}

TEST_F(File, WritingIntoADirectoryThatIsNotThereNamesThePath) {
  EXPECT_EQ(write_file(path("none/a"), "x").error(),
            "cannot write '" + path("none/a") + "': No such file or directory");
}

TEST_F(File, WritingOntoADirectoryIsAnErrorAndLeavesItAlone) {
  EXPECT_EQ(write_file(directory_, "x").error(),
            "cannot write '" + directory_ + "': Is a directory");
  EXPECT_TRUE(fs::is_directory(directory_));
  EXPECT_FALSE(fs::exists(directory_ + ".new"));
}

/// The system refuses to make files larger than that; the closest thing to a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limited{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limited);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST_F(File, AFailedWriteLeavesTheOldContentAndNothingElse) {
  ASSERT_TRUE(write_file(path("a"), "old").ok());
  base::Result<void> result;
  {
    const FileSizeLimit limit(4096);
    result = write_file(path("a"), std::string(10000, 'n'));
  }
  EXPECT_EQ(result.error(), "cannot write '" + path("a") + "': File too large");
  EXPECT_EQ(read_file(path("a")).value(), "old");
  EXPECT_THAT(names(), UnorderedElementsAre("a"));
}

TEST_F(File, ADeviceIsWrittenToAndNotReplaced) {
  EXPECT_EQ(write_file("/dev/full", "x").error(),
            "cannot write '/dev/full': No space left on device");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  EXPECT_TRUE(write_file("/dev/null", "x").ok());
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(File, ALinkStaysALink) {
  ASSERT_TRUE(write_file(path("real"), "old").ok());
  fs::create_symlink("real", path("link"));
  ASSERT_TRUE(write_file(path("link"), "new").ok());
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(read_file(path("real")).value(), "new");
}

TEST_F(File, AReplacedFileKeepsItsPermissions) {
  ASSERT_TRUE(write_file(path("a"), "old").ok());
  fs::permissions(path("a"), fs::perms::owner_read | fs::perms::owner_write);
  ASSERT_TRUE(write_file(path("a"), "new").ok());
  EXPECT_EQ(fs::status(path("a")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(read_file(path("a")).value(), "new");
}

}  // namespace
}  // namespace armature::platform
