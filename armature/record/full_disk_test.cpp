// SPDX-License-Identifier: Apache-2.0
// What every writer does when the disk is full.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "armature/record/csv_writer.hpp"
#include "armature/record/internal/test_types.hpp"
#include "armature/record/mcap_reader.hpp"
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

/// As a disk of 200 kB: the system refuses to make a file larger.
class SmallDisk : public testing::Test {
 protected:
  static constexpr rlim_t kMost = 200'000;
  SmallDisk() {
    ::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{kMost, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() override { ::setrlimit(RLIMIT_FSIZE, &before_); }

  /// Samples until the writer gives up.
  static std::uint32_t fill(Writer& writer) {
    EXPECT_TRUE(writer.add_channel(channel_of("A", 0.0)));
    std::uint32_t written = 0;
    while (written < 1'000'000 &&
           write(writer, 0, written * 1'000'000ll, 0.125 * written, written)) {
      ++written;
    }
    EXPECT_TRUE(writer.given_up());
    EXPECT_FALSE(writer.close());
    return written;
  }

 private:
  rlimit before_{};
};

TEST_F(SmallDisk, HasMostOfAnMcapRecordingToItsLastWholeChunk) {
  const std::string path = testing::TempDir() + "/small_disk.mcap";
  fill(*McapWriter::create(path).value());
  const auto recording = load_mcap(path, Unclosed::kReadToLastChunk);
  ASSERT_TRUE(recording) << recording.error();
  EXPECT_EQ(recording.value().channels.size(), 1u);
  EXPECT_GT(std::filesystem::file_size(path), kMost * 7 / 10);
  ASSERT_GT(recording.value().samples.size(), 500u);
  double last = 0.0;
  const RecordedSample& sample = recording.value().samples.back();
  ASSERT_TRUE(recording.value().read(sample, types::type_of<double>(), &last));
  EXPECT_EQ(last, 0.125 * sample.sequence);
}

TEST_F(SmallDisk, HasACsvRecordingToItsLastWholeRow) {
  const std::string path = testing::TempDir() + "/small_disk.csv";
  fill(*CsvWriter::create(path).value());
  std::ifstream file(path);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_GT(text.size(), kMost * 9 / 10);
  ASSERT_TRUE(text.ends_with('\n'));
  text.pop_back();
  const std::string row = text.substr(text.rfind('\n') + 1);
  EXPECT_NE(row.find(','), std::string::npos) << row;
}

}  // namespace
}  // namespace armature::record
