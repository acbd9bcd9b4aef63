// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/observing/log_history.hpp"

#include <gtest/gtest.h>

#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

rt::LogRecord record_of(int number) {
  rt::LogRecord record(rt::LogLevel::kWarning, base::Time(1ms), "Arm", "line {}");
  record.take({number});
  return record;
}

TEST(LogHistory, KeepsTheNewestLinesAndTheirNumbers) {
  LogHistory history;
  EXPECT_TRUE(history.lines_after(0, 10).empty());
  const int kept = static_cast<int>(LogHistory::kCapacity);
  for (int i = 1; i <= kept + 3; ++i) history.add(record_of(i));
  const std::vector<LogLine> lines = history.lines_after(0, 1000);
  ASSERT_EQ(lines.size(), LogHistory::kCapacity);
  EXPECT_EQ(lines.front(), (LogLine{4, base::Time(1ms), rt::LogLevel::kWarning, "Arm", "line 4"}));
  EXPECT_EQ(lines.back().number, LogHistory::kCapacity + 3);
  EXPECT_EQ(lines.back().text, "line 203");
}

TEST(LogHistory, GivesAsManyAsAreAskedForFromANumberOn) {
  LogHistory history;
  for (int i = 1; i <= 5; ++i) history.add(record_of(i));
  const std::vector<LogLine> lines = history.lines_after(2, 2);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].text, "line 3");
  EXPECT_EQ(lines[1].text, "line 4");
  EXPECT_TRUE(history.lines_after(5, 2).empty());
}

TEST(LogHistory, OfAnApplicationNeedsNoSink) {
  Blueprint blueprint;
  Probe& probe = blueprint.add<Probe>("A", Activity::periodic(1ms));
  probe.actions["start"] = [&] { probe.log_info("in {}", "start"); };
  Application application(std::move(blueprint), patient(true));
  ASSERT_TRUE(application.start().ok());
  EXPECT_TRUE(
      run_until(application, [&] { return !application.log_history().lines_after(0, 1).empty(); }));
  const LogLine line = application.log_history().lines_after(0, 1).front();
  EXPECT_EQ(line.number, 1u);
  EXPECT_EQ(line.component, "A");
  EXPECT_EQ(line.text, "in start");
}

}  // namespace
}  // namespace armature::exec
