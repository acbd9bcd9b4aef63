// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/memory.hpp"

#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

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

}  // namespace
}  // namespace armature::platform
