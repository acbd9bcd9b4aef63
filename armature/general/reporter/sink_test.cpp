// SPDX-License-Identifier: Apache-2.0
#include "armature/general/reporter/sink.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/record/csv_writer.hpp"

namespace armature::general {
namespace {

using ::testing::HasSubstr;

base::Result<std::unique_ptr<record::Writer>> open_table(const std::string& path) {
  auto made = record::CsvWriter::create(path);
  if (!made) return base::Error{made.error()};
  return std::unique_ptr<record::Writer>(std::move(made).value());
}

std::vector<record::Channel> one_number() {
  return {{"A.Out", types::Value::of(0.0), "V", "a number"}};
}

/// Writes 0.5.
void write(Sink& sink, std::int64_t time_ns) {
  std::vector<std::byte> bytes;
  const double value = 0.5;
  types::encode(types::type_of<double>(), &value, bytes);
  sink.write({0, base::time_from_ns(time_ns), 1, bytes});
}

TEST(Sinks, OfAFileThatCannotBeMadeThereIsAnErrorThatNamesIt) {
  EXPECT_THAT(Sink::open("/no/such.csv", open_table, one_number()).error(),
              HasSubstr("cannot write '/no/such.csv'"));
}

TEST(Sinks, OfChannelsThatAreTwoOfAKindThereIsAnError) {
  std::vector<record::Channel> channels = one_number();
  channels.push_back(channels.front());
  EXPECT_THAT(Sink::open("/dev/null", open_table, channels).error(), HasSubstr("'A.Out'"));
}

TEST(Sinks, CountASampleThatWasRefusedAndSayWhyOnce) {
  auto opened = Sink::open("/dev/null", open_table, one_number());
  ASSERT_TRUE(opened);
  Sink& sink = opened.value();
  write(sink, 20);
  write(sink, 10);  // too late for the table
  write(sink, 30);
  EXPECT_EQ(sink.not_written(), 1u);
  EXPECT_THAT(sink.take_complaint(), HasSubstr("samples from 0.000000020 s on"));
  write(sink, 10);
  EXPECT_EQ(sink.take_complaint(), "");
  sink.close();
  EXPECT_EQ(sink.not_written(), 2u);
}

TEST(Sinks, CountAllThatAFullDiskDidNotTakeAndGiveItUp) {
  auto opened = Sink::open("/dev/full", open_table, one_number());
  ASSERT_TRUE(opened);
  Sink& sink = opened.value();
  for (int i = 0; i < 10; ++i) write(sink, i);
  EXPECT_EQ(sink.not_written(), 0u);  // not known yet
  sink.flush();
  EXPECT_EQ(sink.not_written(), 10u);
  EXPECT_EQ(sink.take_complaint(), "cannot write '/dev/full': No space left on device");
  write(sink, 10);
  sink.flush();
  sink.close();
  EXPECT_EQ(sink.not_written(), 11u);
  EXPECT_EQ(sink.take_complaint(), "");
}

TEST(Sinks, AFullDiskThatShowsOnlyAtTheEndIsCountedToo) {
  auto opened = Sink::open("/dev/full", open_table, one_number());
  write(opened.value(), 1);
  opened.value().close();
  EXPECT_EQ(opened.value().not_written(), 1u);
}

}  // namespace
}  // namespace armature::general
