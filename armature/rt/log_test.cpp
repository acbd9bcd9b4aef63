// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/log.hpp"

#include <cstdint>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace armature::rt {
namespace {

LogRecord record_of(const char* format, const LogArgument& first = {},
                    const LogArgument& second = {}, const LogArgument& third = {},
                    const LogArgument& fourth = {}) {
  LogRecord record;
  record.format = format;
  record.take({first, second, third, fourth});
  return record;
}

TEST(LogRecord, PutsEachArgumentInItsPlace) {
  EXPECT_EQ(record_of("joint {} of {}: {} rad, {}", 2u, -7, 0.25, true).message(),
            "joint 2 of -7: 0.25 rad, true");
  EXPECT_EQ(record_of("{}{}", "ab", std::string_view("cd")).message(), "abcd");
}

TEST(LogRecord, KeepsEveryKindOfNumberExactly) {
  EXPECT_EQ(record_of("{}", std::numeric_limits<std::int64_t>::min()).message(),
            "-9223372036854775808");
  EXPECT_EQ(record_of("{}", std::numeric_limits<std::uint64_t>::max()).message(),
            "18446744073709551615");
  EXPECT_EQ(record_of("{} {}", 0.1, 1e300).message(), "0.1 1e+300");
  EXPECT_EQ(record_of("{} {}", false, std::numeric_limits<double>::quiet_NaN()).message(),
            "false nan");
}

TEST(LogRecord, ArgumentsThatAreMissingAreEmptyAndPlacesThatAreTooManyStay) {
  EXPECT_EQ(record_of("<{}>").message(), "<>");
  EXPECT_EQ(record_of("{}{}{}{}{}", 1, 2, 3, 4).message(), "1234{}");
  EXPECT_EQ(record_of("{ } {").message(), "{ } {");
  EXPECT_EQ(LogRecord().message(), "");
}

TEST(LogRecord, KeepsItsOwnCopyOfText) {
  std::string text = "before";
  const LogRecord record = record_of("{}", std::string_view(text));
  text = "after!";
  EXPECT_EQ(record.message(), "before");
}

TEST(LogRecord, SaysOfEachTextThatItIsCut) {
  const std::string text(LogRecord::kTextRoom, 'a');
  LogRecord record;
  record.format = "{}|{}|{}|{}";
  record.take({std::string_view(text), "first of others", "b", "last of others"});
  const std::string message = record.message();
  EXPECT_TRUE(message.ends_with("a...|...|b|la...")) << message.substr(600);
  EXPECT_LE(message.size(), LogRecord::kTextRoom + 3);
}

TEST(LogRecord, KeepsTextsAsLongAsAnyReason) {
  const std::string first(511, 'x');
  const std::string second(100, 'y');
  EXPECT_EQ(record_of("{}: {}", std::string_view(second), std::string_view(first)).message(),
            second + ": " + first);
}

TEST(LogRecord, SaysWhereItLeavesOutTheEndOfATextThatIsLongerStill) {
  const std::string text(1000, 'x');
  EXPECT_EQ(record_of("{}", std::string_view(text)).message(),
            std::string(LogRecord::kTextRoom - 3, 'x') + "...");
  EXPECT_EQ(record_of("{}{} {}", std::string_view(text), std::string_view(text), 7).message(),
            std::string(LogRecord::kTextRoom - 6, 'x') + "...... 7");
}

TEST(LogLevel, HasAName) {
  EXPECT_EQ(name_of(LogLevel::kDebug), "debug");
  EXPECT_EQ(name_of(LogLevel::kInfo), "info");
  EXPECT_EQ(name_of(LogLevel::kWarning), "warning");
  EXPECT_EQ(name_of(LogLevel::kError), "error");
}

TEST(LogQueue, KeepsTheOldestRecordsAndCountsTheOthers) {
  LogQueue queue(2);
  for (int i = 1; i <= 5; ++i) queue.push(record_of("{}", i));
  EXPECT_EQ(queue.dropped(), 3u);
  EXPECT_EQ(queue.pop()->message(), "1");
  EXPECT_EQ(queue.pop()->message(), "2");
  EXPECT_EQ(queue.pop(), nullptr);
  queue.push(record_of("{}", 6));
  EXPECT_EQ(queue.pop()->message(), "6");
  EXPECT_EQ(queue.dropped(), 3u);
}

TEST(LogQueue, CarriesTheWholeRecord) {
  LogQueue queue(1);
  LogRecord record = record_of("late by {}", "3 ms");
  record.level = LogLevel::kWarning;
  record.time = base::time_from_ns(42);
  record.component = "Pid1";
  queue.push(record);
  const LogRecord* const received = queue.pop();
  ASSERT_NE(received, nullptr);
  EXPECT_EQ(received->level, LogLevel::kWarning);
  EXPECT_EQ(received->time, base::time_from_ns(42));
  EXPECT_EQ(received->component.view(), "Pid1");
  EXPECT_EQ(received->message(), "late by 3 ms");
}

}  // namespace
}  // namespace armature::rt
