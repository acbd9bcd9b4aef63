// SPDX-License-Identifier: Apache-2.0
#include "armature/record/black_box_file.hpp"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/file.hpp"
#include "armature/record/mcap_reader.hpp"

namespace armature::record {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

exec::BlackBoxReport report() {
  exec::BlackBoxReport made;
  made.component = "Joint1";
  made.reason = "the encoder does not answer";
  made.time = base::time_from_ns(2'500'000'000);
  made.channels.push_back({"Joint1.Position", types::Value::of(0.0), "rad", "angle"});
  for (int i = 1; i <= 2; ++i) {
    const double value = 0.5 * i;
    exec::BlackBoxReport::Sample sample{0, base::time_from_ns(i * 1'000'000'000), {}};
    types::encode(types::type_of<double>(), &value, sample.value);
    made.samples.push_back(sample);
  }
  made.happenings.push_back({made.time, "Joint1", "fault", "", made.reason});
  return made;
}

/// An empty folder of this test.
std::string folder() {
  const std::string path =
      ::testing::TempDir() + ::testing::UnitTest::GetInstance()->current_test_info()->name();
  std::filesystem::remove_all(path);
  std::filesystem::create_directories(path);
  return path;
}

TEST(BlackBoxFile, HasEachPortWhatHappenedAndTheFault) {
  const auto path = write_black_box(report(), folder());
  ASSERT_TRUE(path) << path.error();
  EXPECT_THAT(path.value(), MatchesRegex(".*/blackbox-Joint1-20..-..-..T..-..-..\\.mcap"));
  const auto loaded = load_mcap(path.value());
  ASSERT_TRUE(loaded) << loaded.error();
  std::vector<std::string> texts;
  for (const RecordedSample& sample : loaded.value().samples) {
    texts.push_back(loaded.value().channels[sample.channel].name + " " +
                    std::to_string(base::to_ns(sample.time)) + " " + sample.json);
  }
  EXPECT_THAT(
      texts,
      ElementsAre(
          R"(Joint1.Position 1000000000 {"value":0.5})",
          R"(Joint1.Position 2000000000 {"value":1})",
          R"(events 2500000000 {"component":"Joint1","kind":"fault","item":"","text":"the encoder does not answer"})"));
  EXPECT_THAT(platform::read_file(path.value()).value(),
              HasSubstr(std::string("reason\x1b\0\0\0the encoder does not answer", 37)));
}

TEST(BlackBoxFile, TwoOfOneSecondHaveTwoNames) {
  const std::string where = folder();
  const auto first = write_black_box(report(), where);
  const auto second = write_black_box(report(), where);
  ASSERT_TRUE(first) << first.error();
  ASSERT_TRUE(second) << second.error();
  EXPECT_NE(first.value(), second.value());
  EXPECT_EQ(platform::read_file(first.value()).value(),
            platform::read_file(second.value()).value());
}

TEST(BlackBoxFile, SaysWhereItIsOrWhyNot) {
  const std::string where = folder();
  EXPECT_THAT(say_written(report(), where),
              MatchesRegex("what led to the fault of Joint1 is in .*/blackbox-Joint1-.*"));
  EXPECT_THAT(say_written(report(), "/no/such/folder"),
              MatchesRegex("what led to the fault of Joint1 is lost: cannot write "
                           "'/no/such/folder/.*': No such file or directory"));
}

}  // namespace
}  // namespace armature::record
