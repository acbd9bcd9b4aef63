// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/memory.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "armature/base/unit.hpp"

namespace armature::platform {
namespace {

TEST(Memory, GrowsWithWhatIsTouched) {
  constexpr std::size_t kBytes = 32u << 20;
  const std::size_t before = resident_bytes();
  EXPECT_GT(before, 0u);
  const std::vector<char> touched(kBytes, 'x');
  EXPECT_GT(resident_bytes(), before + kBytes / 2) << touched.back();
}

/// Ends the process with status 0 and the reason on stderr if memory cannot be locked.
[[noreturn]] void lock_without_permission() {
  const rlimit nothing{0, 0};
  ::setrlimit(RLIMIT_MEMLOCK, &nothing);
  if (::getuid() == 0 && ::setuid(65534) != 0) std::_Exit(2);
  const base::Result<void> result = lock_memory();
  if (result.ok()) std::_Exit(1);
  std::fprintf(stderr, "%s\n", result.error().c_str());
  std::_Exit(0);
}

TEST(MemoryDeathTest, ARefusalSaysHowToGetThePermission) {
  if (std::string_view(ARMATURE_SANITIZER) != "") GTEST_SKIP() << "sanitizers never lock memory";
  EXPECT_EXIT(lock_without_permission(), ::testing::ExitedWithCode(0),
              "memory cannot be locked: .*; run as root, or raise memlock in "
              "/etc/security/limits.conf, or give the program CAP_IPC_LOCK");
}

TEST(Memory, IsLockedWherePermitted) {
  const base::Result<void> result = lock_memory();
  if (!result.ok()) GTEST_SKIP() << result.error();
  unlock_memory();
}

/// The page that `parse_unit` begins in is in memory for this process.
bool code_of_base_is_resident() {
  const auto address = reinterpret_cast<std::uintptr_t>(&base::parse_unit);
  const auto page = address / static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  std::uint64_t entry = 0;
  const int map = ::open("/proc/self/pagemap", O_RDONLY | O_CLOEXEC);
  const auto offset = static_cast<off_t>(page * sizeof entry);
  EXPECT_EQ(::pread(map, &entry, sizeof entry, offset), static_cast<ssize_t>(sizeof entry));
  ::close(map);
  return (entry >> 63) != 0;
}

void expect_that_code_goes_and_comes_back() {
  constexpr std::string_view kBase[] = {"libother.so", "libarmature_base.so"};
  ASSERT_TRUE(base::parse_unit("rad/s").ok());
  ASSERT_TRUE(code_of_base_is_resident());
  release_code(kBase);
  EXPECT_FALSE(code_of_base_is_resident());
  EXPECT_TRUE(base::parse_unit("rad/s").ok());
  EXPECT_TRUE(code_of_base_is_resident());
}

TEST(Memory, ReleasedCodeIsReadAgainWhenItIsCalled) { expect_that_code_goes_and_comes_back(); }

TEST(Memory, LockedCodeIsReleasedToo) {
  const base::Result<void> result = lock_memory();
  if (!result.ok()) GTEST_SKIP() << result.error();
  expect_that_code_goes_and_comes_back();
  unlock_memory();
}

TEST(Memory, TheCodeOfOtherLibrariesStays) {
  constexpr std::string_view kOthers[] = {"libother.so", "base"};
  ASSERT_TRUE(base::parse_unit("rad/s").ok());
  release_code(kOthers);
  EXPECT_TRUE(code_of_base_is_resident());
}

}  // namespace
}  // namespace armature::platform
