// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/pages.hpp"

#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "armature/platform/memory.hpp"

namespace armature::platform {
namespace {

constexpr std::size_t kMiB = 1 << 20;

TEST(Pages, KeepTheirBytesWhenTheyGrowAndAreGivenBackAtOnce) {
  const std::size_t before = resident_bytes();
  auto* at = static_cast<char*>(resize_pages(nullptr, 0, kMiB));
  ASSERT_NE(at, nullptr);
  std::memset(at, 7, kMiB);
  at = static_cast<char*>(resize_pages(at, kMiB, 64 * kMiB));
  ASSERT_NE(at, nullptr);
  EXPECT_EQ(at[0] + at[kMiB - 1], 14);
  std::memset(at, 8, 64 * kMiB);
  EXPECT_GE(resident_bytes(), before + 60 * kMiB);
  EXPECT_EQ(resize_pages(at, 64 * kMiB, 0), nullptr);
  EXPECT_LT(resident_bytes(), before + 8 * kMiB);
}

TEST(Pages, ThatThereAreNotLeaveWhatIsThere) {
  auto* const at = static_cast<char*>(resize_pages(nullptr, 0, kMiB));
  ASSERT_NE(at, nullptr);
  at[5] = 3;
  EXPECT_EQ(resize_pages(at, kMiB, std::numeric_limits<std::size_t>::max() - kMiB + 1), nullptr);
  EXPECT_EQ(at[5], 3);
  resize_pages(at, kMiB, 0);
}

}  // namespace
}  // namespace armature::platform
