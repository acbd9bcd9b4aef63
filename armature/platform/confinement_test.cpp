// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/confinement.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/landlock.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "armature/platform/file.hpp"
#include "armature/platform/output_file.hpp"

namespace armature::platform {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// There is no way back, so that each test is a process of its own.
class Confinement : public ::testing::Test {
 protected:
  Confinement() {
    std::string pattern = ::testing::TempDir() + "confinement-XXXXXX";
    root_ = ::mkdtemp(pattern.data());
    fs::create_directories(root_ / "in");
    fs::create_directories(root_ / "in-front");
    std::ofstream(root_ / "mine") << "as it was";
  }
  ~Confinement() override { fs::remove_all(root_); }
  std::string path(const char* name) const { return (root_ / name).string(); }
  std::string content(const char* name) const { return read_file(path(name)).value(); }

  /// Ends with the status 0 if all is as expected.
  void go_about_it() const {
    if (!write_only_in(path("in"))) std::_Exit(1);
    if (!write_file(path("in/new"), "1") || !OutputFile::create(path("in/grows"))) std::_Exit(2);
    if (write_file(path("mine"), "2") || write_file(path("in/../mine"), "2")) std::_Exit(3);
    if (OutputFile::create(path("in-front/new")) || expect_writable(path("mine"))) std::_Exit(4);
    if (write_file(path("in/link"), "2")) std::_Exit(5);
    if (write_file(path("mine"), "2").error().find("may change files in") == std::string::npos)
      std::_Exit(6);
    std::ofstream(path("mine")) << "by a library that knows nothing of this";
    std::_Exit(read_file(path("mine")).ok() ? 0 : 7);
  }

  fs::path root_;
};

TEST_F(Confinement, WritesInItsFolderAlone) {
  fs::create_symlink(path("mine"), path("in/link"));
  EXPECT_EXIT(go_about_it(), ::testing::ExitedWithCode(0), "");
  EXPECT_EQ(content("in/new"), "1");
  EXPECT_FALSE(fs::exists(path("in-front/new")));
}

TEST_F(Confinement, TheKernelKeepsItsWallAlsoBeforeOtherCode) {
  const long version =
      ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) GTEST_SKIP() << "this kernel has no Landlock";
  EXPECT_EXIT(
      {
        static_cast<void>(write_only_in(path("in")));
        std::ofstream(path("in/other")) << "1";
        std::ofstream(path("mine")) << "2";
        std::error_code refused;
        fs::remove(path("mine"), refused);
        std::_Exit(refused ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
  EXPECT_EQ(content("mine"), "as it was");
  EXPECT_EQ(content("in/other"), "1");
}

TEST_F(Confinement, NobodyIsConfinedWhoDidNotAskForIt) {
  EXPECT_TRUE(expect_inside("/anywhere"));
  EXPECT_FALSE(write_only_in(path("nowhere")));
}

}  // namespace
}  // namespace armature::platform
