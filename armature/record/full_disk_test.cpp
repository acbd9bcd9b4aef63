// SPDX-License-Identifier: Apache-2.0
// What every writer does when the disk is full.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/record/csv_writer.hpp"
#include "armature/record/internal/test_types.hpp"
#include "armature/record/mcap_writer.hpp"

namespace armature::record {
namespace {

constexpr const char* kFull = "cannot write '/dev/full': No space left on device";

TEST(FullDisk, TheCsvWriterSaysSoAtEachCallFromThenOn) {
  auto created = CsvWriter::create("/dev/full");
  ASSERT_TRUE(created);
  CsvWriter& writer = *created.value();
  ASSERT_TRUE(writer.add_channel(channel_of("A", 0.0)));
  int written = 0;
  while (write(writer, 0, written, 0.5)) ASSERT_LT(++written, 100'000);
  ASSERT_GT(written, 1000);  // what fits into the memory in between
  EXPECT_EQ(write(writer, 0, written, 0.5).error(), kFull);
  EXPECT_TRUE(writer.given_up());
  EXPECT_EQ(writer.unsaved(), static_cast<std::uint64_t>(written));
  EXPECT_EQ(writer.flush().error(), kFull);
  EXPECT_EQ(writer.add_channel(channel_of("B", 0.0)).error(), kFull);
  EXPECT_EQ(writer.close().error(), kFull);
}

TEST(FullDisk, TheCsvWriterSaysSoWhenItIsClosedAtTheLatest) {
  auto created = CsvWriter::create("/dev/full");
  EXPECT_EQ(created.value()->close().error(), kFull);
}

TEST(FullDisk, TheMcapWriterSaysSoAtOnce) {
  EXPECT_EQ(McapWriter::create("/dev/full").error(), kFull);
}

}  // namespace
}  // namespace armature::record
