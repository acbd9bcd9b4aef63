// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/acts.hpp"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::replay {
namespace {

using exec::Act;
using ::testing::HasSubstr;

std::string problem_in(const std::string& line) {
  const auto acts = parse_acts(line + "\n", "acts.jsonl");
  return acts ? "" : acts.error();
}

TEST(ActsFile, HasAnActAsSoonAsItWasTold) {
  const std::string folder = ::testing::TempDir() + "acts_file_test";
  std::filesystem::create_directories(folder);
  auto writer = ActsWriter::create(folder);
  ASSERT_TRUE(writer.ok()) << writer.error();
  for (std::uint64_t turn = 1; turn <= 100; ++turn) {
    writer.value()->add({.kind = Act::Kind::kStart, .component = "Arm", .turn = turn});
    const auto acts = load_acts(folder);
    ASSERT_TRUE(acts.ok()) << acts.error();
    ASSERT_EQ(acts.value().size(), turn) << "it outlives the process that does it now";
  }
  writer.value()->add({.kind = exec::Act::Kind::kRefused, .item = "it is broken", .number = 2});
  const auto acts = load_acts(folder);
  ASSERT_TRUE(acts.ok()) << acts.error();
  EXPECT_EQ(acts.value().size(), 100u);
  EXPECT_EQ(acts.value()[1].refused, "it is broken");
  EXPECT_FALSE(acts.value()[0].refused.has_value());
  EXPECT_TRUE(writer.value()->close().ok());
  std::filesystem::remove_all(folder);
}

TEST(ActsFile, OfARunInRealTimeHasTheTimeAtWhichEachActWasDone) {
  const std::string folder = ::testing::TempDir() + "acts_in_real_time_test";
  std::filesystem::create_directories(folder);
  auto writer = ActsWriter::create(folder, ActsWait::kNot);
  ASSERT_TRUE(writer.ok()) << writer.error();
  for (const int ms : {10, 20}) {
    writer.value()->add({.kind = Act::Kind::kStart,
                         .component = "Arm",
                         .time = base::time_from_ns(ms * 1'000'000)});
  }
  writer.value()->add(
      {.kind = Act::Kind::kDone, .time = base::time_from_ns(21'000'000), .number = 2});
  EXPECT_TRUE(writer.value()->close().ok());
  const auto acts = load_acts(folder);
  ASSERT_TRUE(acts.ok()) << acts.error();
  ASSERT_EQ(acts.value().size(), 2u);
  EXPECT_EQ(base::to_ns(acts.value()[0].act.time), 10'000'000);
  EXPECT_EQ(base::to_ns(acts.value()[1].act.time), 21'000'000);
  std::filesystem::remove_all(folder);
}

TEST(ActsFile, ThatIsWrongIsRefusedWithItsLine) {
  const std::string good = R"({"time_ns":10,"turn":1,"act":"end"})";
  EXPECT_EQ(problem_in(good), "");
  EXPECT_THAT(problem_in(good + "\n[]"), HasSubstr("acts.jsonl:2: not what armature run leaves"));
  EXPECT_THAT(problem_in(good + "\n{\"refused\":2,\"why\":\"\"}"), HasSubstr("no such act"));
  EXPECT_THAT(problem_in(R"({"refused":0,"why":""})"), HasSubstr("no such act"));
  EXPECT_THAT(problem_in(good + "\n{\"done\":2,\"time_ns\":1}"), HasSubstr("no such act"));
  EXPECT_THAT(problem_in(R"({"time_ns":1,"turn":1,"act":"done"})"), HasSubstr("unknown act"));
  EXPECT_THAT(problem_in(good + "\n{\"lost\":true}"), HasSubstr("acts are missing from here on"));
  EXPECT_THAT(problem_in(R"({"time_ns":1e300,"turn":1,"act":"end"})"),
              HasSubstr("time_ns must be a whole number"));
  EXPECT_THAT(problem_in(R"({"time_ns":1,"turn":-1,"act":"end"})"),
              HasSubstr("turn must be a whole number"));
  EXPECT_THAT(problem_in(R"({"time_ns":1,"turn":1,"act":"set","command":4294967296})"),
              HasSubstr("command must be a whole number"));
  EXPECT_THAT(problem_in(R"({"time_ns":1,"turn":1,"act":"fly"})"), HasSubstr("unknown act"));
  EXPECT_THAT(problem_in(R"({"time_ns":1,"turn":1,"act":"set","values":[1]})"),
              HasSubstr("not what armature run leaves"));
}

}  // namespace
}  // namespace armature::replay
