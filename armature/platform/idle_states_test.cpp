// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/idle_states.hpp"

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "armature/platform/file.hpp"

namespace armature::platform {
namespace {

bool is_open(const std::string& path) {
  struct stat wanted {};
  ::stat(path.c_str(), &wanted);
  for (int descriptor = 0; descriptor < 1024; ++descriptor) {
    struct stat found {};
    if (::fstat(descriptor, &found) != 0) continue;
    if (found.st_ino == wanted.st_ino && found.st_dev == wanted.st_dev) return true;
  }
  return false;
}

TEST(IdleStateHold, AsksForNoLatencyAndKeepsTheDeviceOpenWhileItLives) {
  const std::string device = ::testing::TempDir() + "idle_states_device";
  ASSERT_TRUE(write_file(device, "").ok());
  {
    base::Result<IdleStateHold> hold = IdleStateHold::take(device);
    ASSERT_TRUE(hold.ok());
    const IdleStateHold moved = std::move(hold).value();
    EXPECT_TRUE(is_open(device));
    const std::string written = read_file(device).value();
    const std::int32_t zero = 0;
    ASSERT_EQ(written.size(), sizeof zero);
    EXPECT_EQ(std::memcmp(written.data(), &zero, sizeof zero), 0);
  }
  EXPECT_FALSE(is_open(device));
  ::unlink(device.c_str());
}

TEST(IdleStateHold, ARefusalSaysHowToGetThePermission) {
  const base::Result<IdleStateHold> hold = IdleStateHold::take("/nowhere/cpu_dma_latency");
  ASSERT_FALSE(hold.ok());
  EXPECT_EQ(hold.error(),
            "deep idle states cannot be held off: /nowhere/cpu_dma_latency: No such file or "
            "directory; run as root, or let your group write the device by a udev rule");
}

}  // namespace
}  // namespace armature::platform
