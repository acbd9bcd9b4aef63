// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/file.hpp"
#include "armature/record/internal/mcap_format.hpp"
#include "armature/record/internal/test_types.hpp"
#include "armature/record/mcap_reader.hpp"
#include "armature/record/mcap_writer.hpp"

namespace armature::record {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using types::type_of;

std::string temporary(const std::string& name) { return testing::TempDir() + "/" + name; }

std::unique_ptr<McapWriter> make_writer(const std::string& path, std::size_t chunk_size = 1 << 20) {
  auto writer = McapWriter::create(path, {chunk_size});
  EXPECT_TRUE(writer) << writer.error();
  return std::move(writer).value();
}

/// A recording with two types, three channels and more than one chunk.
std::string small_file() {
  const std::string path = temporary("small.mcap");
  const auto writer = make_writer(path, 200);
  EXPECT_TRUE(writer->add_channel(channel_of("PID1.Out", 0.0, "rad", "what it says")));
  EXPECT_TRUE(writer->add_channel(channel_of("Head.pose", Pose{})));
  EXPECT_TRUE(write(*writer, 0, 10, 0.5, 1));
  EXPECT_TRUE(write(*writer, 1, 10, Pose{1, 2}, 1));
  EXPECT_TRUE(write(*writer, 0, 20, -0.5, 2));
  EXPECT_TRUE(writer->add_channel(channel_of("PID2.Out", 0.0)));
  EXPECT_TRUE(write(*writer, 2, 30, 3.0, 1));
  EXPECT_TRUE(writer->close());
  return platform::read_file(path).value();
}

/// The same without CRCs, so that damage gets as far as it can.
std::string without_crcs(std::string file) {
  namespace mcap = internal::mcap;
  const std::size_t footer = file.size() - mcap::kMagic.size() - mcap::kFooterRecord;
  std::uint64_t summary = 0;
  mcap::Cursor(std::string_view(file).substr(footer + mcap::kRecordHead)).take(summary);
  constexpr std::size_t kCrc = sizeof(std::uint32_t);
  file.replace(footer + mcap::kFooterRecord - kCrc, kCrc, kCrc, '\0');
  file.replace(summary - kCrc, kCrc, kCrc, '\0');
  constexpr std::size_t kCrcInChunk = mcap::kRecordHead + 24;
  for (std::size_t place = mcap::kMagic.size(); place < summary;) {
    std::uint64_t size = 0;
    mcap::Cursor(std::string_view(file).substr(place + 1)).take(size);
    if (file[place] == static_cast<char>(mcap::Op::kChunk)) {
      file.replace(place + kCrcInChunk, kCrc, kCrc, '\0');
    }
    place += mcap::kRecordHead + size;
  }
  return file;
}

std::string problem(std::string_view content) {
  const auto recording = parse_mcap(content, "a.mcap");
  return recording ? "none" : recording.error();
}

TEST(Mcap, ReadsWhatWasWritten) {
  const auto read = parse_mcap(small_file(), "small.mcap");
  ASSERT_TRUE(read) << read.error();
  const McapRecording& recording = read.value();
  ASSERT_EQ(recording.channels.size(), 3u);
  EXPECT_EQ(recording.channels[0],
            (RecordedChannel{"PID1.Out", "double", "double", "rad", "what it says"}));
  EXPECT_EQ(recording.channels[1],
            (RecordedChannel{"Head.pose", "Pose", "Pose{x:double,y:double}", "", ""}));
  ASSERT_EQ(recording.samples.size(), 4u);
  EXPECT_EQ(recording.samples[2],
            (RecordedSample{0, base::time_from_ns(20), 2, R"({"value":-0.5})"}));
  Pose pose;
  ASSERT_TRUE(recording.read(recording.samples[1], type_of<Pose>(), &pose));
  EXPECT_EQ(pose, (Pose{1, 2}));
}

TEST(Mcap, EveryKindOfTypeComesBackAsItWas) {
  const std::string path = temporary("everything.mcap");
  const auto writer = make_writer(path);
  ASSERT_TRUE(writer->add_channel(channel_of("All", Everything{})));
  ASSERT_TRUE(writer->add_channel(channel_of("Text", std::string())));
  ASSERT_TRUE(write(*writer, 0, 0, make_everything()));
  ASSERT_TRUE(write(*writer, 1, 0, std::string("µ,\"\n")));
  ASSERT_TRUE(write(*writer, 0, 1, Everything{}));
  ASSERT_TRUE(writer->close());
  const auto recording = load_mcap(path);
  ASSERT_TRUE(recording) << recording.error();
  const auto& samples = recording.value().samples;
  Everything everything;
  ASSERT_TRUE(recording.value().read(samples[0], type_of<Everything>(), &everything));
  EXPECT_EQ(everything, make_everything());
  std::string text;
  ASSERT_TRUE(recording.value().read(samples[1], type_of<std::string>(), &text));
  EXPECT_EQ(text, "µ,\"\n");
  ASSERT_TRUE(recording.value().read(samples[2], type_of<Everything>(), &everything));
  EXPECT_EQ(everything, Everything{});
}

TEST(Mcap, TheLastTimeThereIsComesBack) {
  const std::string path = temporary("late.mcap");
  const auto writer = make_writer(path);
  ASSERT_TRUE(writer->add_channel(channel_of("A", 0)));
  ASSERT_TRUE(write(*writer, 0, INT64_MAX, 1, UINT32_MAX));
  ASSERT_TRUE(writer->close());
  const auto recording = load_mcap(path);
  EXPECT_EQ(recording.value().samples[0].time, base::Time::max());
  EXPECT_EQ(recording.value().samples[0].sequence, UINT32_MAX);
}

TEST(Mcap, ARecordingWithoutSamplesOrChannelsIsOne) {
  const std::string path = temporary("empty.mcap");
  ASSERT_TRUE(make_writer(path)->close());
  const auto none = load_mcap(path);
  ASSERT_TRUE(none) << none.error();
  EXPECT_TRUE(none.value().channels.empty());
  const auto writer = make_writer(path);
  ASSERT_TRUE(writer->add_channel(channel_of("A", 0)));
  ASSERT_TRUE(writer->close());
  EXPECT_EQ(load_mcap(path).value().channels.size(), 1u);
}

TEST(Mcap, TheSameCallsGiveTheSameBytes) { EXPECT_EQ(small_file(), small_file()); }

TEST(Mcap, DestructionClosesTheFile) {
  const std::string path = temporary("destroyed.mcap");
  { make_writer(path); }
  EXPECT_TRUE(load_mcap(path));
}

TEST(Mcap, FlushHandsOverTheMessagesSoFar) {
  const std::string path = temporary("flushed.mcap");
  const auto writer = make_writer(path);
  ASSERT_TRUE(writer->add_channel(channel_of("A", 0)));
  ASSERT_TRUE(write(*writer, 0, 1, 12345));
  EXPECT_EQ(writer->unsaved(), 1u);
  ASSERT_TRUE(writer->flush());
  EXPECT_EQ(writer->unsaved(), 0u);
  EXPECT_THAT(platform::read_file(path).value(), HasSubstr(R"({"value":12345})"));
}

TEST(Mcap, AFileThatWasCutOffIsRefusedWhereverItWasCut) {
  const std::string whole = small_file();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(problem(std::string(whole, 0, size)), "none") << size;
  }
  EXPECT_EQ(
      problem(whole.substr(0, 300)),
      "cannot read 'a.mcap': at byte 300 expected a footer and the magic bytes before it: the "
      "file was cut off or never closed");
  EXPECT_THAT(problem(""), HasSubstr("at byte 0 expected the magic bytes of an MCAP file"));
}

TEST(Mcap, AFileThatWasCutOffIsReadToItsLastWholeChunkIfAskedFor) {
  const std::string whole = small_file();
  const McapRecording all = parse_mcap(whole, "a.mcap", Unclosed::kReadToLastChunk).value();
  EXPECT_TRUE(all.closed);
  ASSERT_EQ(all.samples.size(), 4u);
  std::size_t least = 0;
  std::size_t refused = 0;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto cut = parse_mcap(whole.substr(0, size), "a.mcap", Unclosed::kReadToLastChunk);
    if (!cut) {
      ++refused;
      EXPECT_EQ(refused, size + 1);  // only within the magic bytes and the header
      continue;
    }
    const McapRecording& recording = cut.value();
    EXPECT_FALSE(recording.closed);
    ASSERT_GE(recording.samples.size(), least) << size;
    least = recording.samples.size();
    EXPECT_TRUE(std::equal(recording.samples.begin(), recording.samples.end(), all.samples.begin()))
        << size;
  }
  EXPECT_EQ(least, 4u);
  EXPECT_LT(refused, 40u);
}

TEST(Mcap, DamageInAFileThatWasCutOffIsFound) {
  std::string cut = small_file();
  cut.resize(cut.size() - 1);
  cut[cut.find("0.5")] = '7';
  const auto recording = parse_mcap(cut, "a.mcap", Unclosed::kReadToLastChunk);
  ASSERT_FALSE(recording);
  EXPECT_THAT(recording.error(), HasSubstr("the chunk to have its CRC: the file is damaged"));
}

TEST(Mcap, EveryDamagedByteIsFound) {
  const std::string whole = small_file();
  for (std::size_t place = 0; place < whole.size(); ++place) {
    for (const int flipped : {0x01, 0x80, 0xFF}) {
      std::string damaged = whole;
      damaged[place] = static_cast<char>(damaged[place] ^ flipped);
      EXPECT_THAT(problem(damaged), HasSubstr("cannot read 'a.mcap': at byte ")) << place;
    }
  }
  std::string damaged = whole;
  damaged[damaged.find("0.5")] = '7';
  EXPECT_THAT(problem(damaged), HasSubstr("the chunk to have its CRC: the file is damaged"));
}

TEST(Mcap, DamageWithoutCrcsIsSurvived) {
  const std::string whole = without_crcs(small_file());
  ASSERT_EQ(problem(whole), "none");
  int refused = 0;
  for (std::size_t place = 0; place < whole.size(); ++place) {
    for (const int flipped : {0x01, 0x02, 0x40, 0x80, 0xFF}) {
      std::string damaged = whole;
      damaged[place] = static_cast<char>(damaged[place] ^ flipped);
      const auto recording = parse_mcap(damaged, "a.mcap");
      if (!recording) {
        ++refused;
        continue;
      }
      for (const RecordedSample& sample : recording.value().samples) {
        Pose pose;
        static_cast<void>(recording.value().read(sample, type_of<Pose>(), &pose).ok());
      }
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(Mcap, AChunkThatIsCompressedInAnotherWayIsRefused) {
  std::string file = without_crcs(small_file());
  constexpr std::size_t kChunk = 33;
  constexpr std::size_t kCompression = kChunk + internal::mcap::kRecordHead + 28;
  // Its name takes the place of the stored size and a little more: there are then no records.
  file.replace(kCompression, 16, std::string("\x04\0\0\0gzip\0\0\0\0\0\0\0\0", 16));
  EXPECT_THAT(problem(file), HasSubstr("expected zstd, lz4 or nothing, found 'gzip'"));
}

TEST(Mcap, AnotherTypeThanTheRecordedOneIsRefused) {
  const auto recording = parse_mcap(small_file(), "a.mcap");
  double value = 0;
  EXPECT_EQ(recording.value().read(recording.value().samples[1], type_of<double>(), &value).error(),
            "'a.mcap': channel 'Head.pose' is expected to be double, but is "
            "Pose{x:double,y:double}");
}

TEST(Mcap, AFileThatIsNotThereIsNamed) {
  EXPECT_THAT(load_mcap("/no/such.mcap").error(), HasSubstr("/no/such.mcap"));
}

TEST(McapWriter, RefusesAChannelAndContinues) {
  const auto writer = make_writer(temporary("channels.mcap"));
  ASSERT_TRUE(writer->add_channel(channel_of("A", 0)));
  EXPECT_THAT(writer->add_channel(channel_of("A", 0.0)).error(),
              AllOf(HasSubstr("channels.mcap"), HasSubstr("channel 'A' is added already")));
  EXPECT_THAT(writer->add_channel(channel_of("", 0)).error(), HasSubstr("a channel needs a name"));
  EXPECT_THAT(writer->add_channel(channel_of("\xff", 0)).error(), HasSubstr("UTF-8"));
  EXPECT_EQ(writer->add_channel(channel_of("B", 0)).value(), 1);
}

TEST(McapWriter, RefusesASampleAndContinues) {
  const std::string path = temporary("samples.mcap");
  const auto writer = make_writer(path);
  ASSERT_TRUE(writer->add_channel(channel_of("A", 0)));
  EXPECT_THAT(write(*writer, 1, 0, 0).error(), HasSubstr("one of 1 channels, but is of number 1"));
  EXPECT_THAT(write(*writer, 0, -1, 0).error(), HasSubstr("a time from 0 on, but has -1 ns"));
  EXPECT_THAT(write(*writer, 0, 0, 0.0).error(), HasSubstr("samples of 4 bytes, but one has 8"));
  EXPECT_THAT(write(*writer, 0, 0, false).error(), HasSubstr("channel 'A' has an invalid sample"));
  EXPECT_TRUE(write(*writer, 0, 0, 5));
  ASSERT_TRUE(writer->close());
  EXPECT_EQ(load_mcap(path).value().samples.size(), 1u);
}

TEST(McapWriter, RefusesToWriteOnceItIsClosed) {
  const auto writer = make_writer(temporary("closed.mcap"));
  ASSERT_TRUE(writer->add_channel(channel_of("A", 0)));
  ASSERT_TRUE(writer->close());
  EXPECT_TRUE(writer->close());
  EXPECT_THAT(write(*writer, 0, 0, 0).error(), HasSubstr("is closed already"));
  EXPECT_FALSE(writer->flush());
  EXPECT_FALSE(writer->add_channel(channel_of("B", 0)));
}

TEST(McapWriter, SaysThatTheFileCannotBeMade) {
  EXPECT_THAT(McapWriter::create("/no/such/folder/a.mcap").error(),
              HasSubstr("cannot write '/no/such/folder/a.mcap': No such file or directory"));
  EXPECT_EQ(McapWriter::create("/dev/full").error(),
            "cannot write '/dev/full': No space left on device");
}

class McapForms : public ::testing::TestWithParam<std::tuple<McapWriter::Profile, const char*>> {
 protected:
  static McapWriter::Options options() {
    const auto& [profile, compression] = GetParam();
    return {.chunk_size = 500, .profile = profile, .compression = compression};
  }
  /// A hundred samples of everything.
  static std::string written() {
    if (!McapWriter::can_compress(options().compression)) return {};
    const std::string path = temporary("forms.mcap");
    auto writer = McapWriter::create(path, options());
    EXPECT_TRUE(writer) << writer.error();
    EXPECT_TRUE(writer.value()->add_channel(channel_of("All", types::make_everything())));
    for (int i = 0; i < 100; ++i) {
      types::Everything value = types::make_everything();
      value.i32 = i;
      EXPECT_TRUE(write(*writer.value(), 0, i, value));
    }
    EXPECT_TRUE(writer.value()->close());
    return platform::read_file(path).value();
  }
};

TEST_P(McapForms, AllAreReadBackAsTheyWere) {
  const std::string file = written();
  if (file.empty()) GTEST_SKIP() << "built without";
  const auto recording = parse_mcap(file, "forms.mcap");
  ASSERT_TRUE(recording) << recording.error();
  ASSERT_EQ(recording.value().samples.size(), 100u);
  types::Everything expected = types::make_everything();
  expected.i32 = 0;
  for (const RecordedSample& sample : recording.value().samples) {
    types::Everything found;
    const auto read = recording.value().read(sample, type_of<types::Everything>(), &found);
    ASSERT_TRUE(read) << read.error();
    EXPECT_EQ(found, expected);
    ++expected.i32;
  }
}

TEST_P(McapForms, DamageIsFound) {
  const std::string file = without_crcs(written());
  if (file.size() < 1000) GTEST_SKIP() << "built without";
  for (std::size_t place = 300; place < 2000; place += 7) {
    std::string damaged = file;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x55);
    const auto recording = parse_mcap(damaged, "forms.mcap");
    if (!recording) EXPECT_THAT(recording.error(), HasSubstr("at byte ")) << place;
  }
}

INSTANTIATE_TEST_SUITE_P(All, McapForms,
                         ::testing::Combine(::testing::Values(McapWriter::Profile::kNone,
                                                              McapWriter::Profile::kRos2),
                                            ::testing::Values("", "zstd", "lz4")));

TEST(McapCompression, AnotherOneIsRefusedAndSaysWhichThereAre) {
  const auto writer = McapWriter::create(temporary("odd.mcap"), {.compression = "gzip"});
  ASSERT_FALSE(writer);
  EXPECT_THAT(writer.error(), HasSubstr("expected zstd, lz4 or nothing, found 'gzip'"));
}

}  // namespace
}  // namespace armature::record
