// SPDX-License-Identifier: Apache-2.0
#include "armature/record/timeline_writer.hpp"

#include <string>

#include <gtest/gtest.h>

#include "armature/platform/file.hpp"

namespace armature::record {
namespace {

using exec::TimelineSlice;
using Kind = exec::TimelineSlice::Kind;

std::string path_of_this_test() {
  return testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name() +
         ".json";
}

std::string contents(const std::string& path) { return platform::read_file(path).value(); }

TimelineSlice slice(Kind kind, std::int64_t begin_ns, std::int64_t length_ns) {
  TimelineSlice made;
  made.kind = kind;
  made.thread = 1;
  made.thread_name = "control";
  made.begin = base::time_from_ns(begin_ns);
  made.length = base::Duration(length_ns);
  made.cycle = 7;
  made.cycle_time = base::time_from_ns(10'000'000);
  return made;
}

TEST(TimelineWriter, WritesAnArrayOfTraceEvents) {
  const std::string path = path_of_this_test();
  auto created = TimelineWriter::create(path);
  ASSERT_TRUE(created) << created.error();
  TimelineWriter& writer = *created.value();
  TimelineSlice cycle = slice(Kind::kCycle, 10'000'000, 12'345);
  cycle.detailed = true;
  writer.add(cycle);
  TimelineSlice step = slice(Kind::kStep, 10'000'001, 1'002);
  step.component = "Joint\"1";
  writer.add(step);
  TimelineSlice later = slice(Kind::kMessages, 12'000'000, 50);
  later.missing = 3;
  writer.add(later);
  TimelineSlice lost = slice(Kind::kLost, 12'000'050, 0);
  lost.missing = 9;
  writer.add(lost);
  ASSERT_TRUE(writer.close());
  EXPECT_EQ(contents(path),
            R"([{"ph":"M","name":"process_name","pid":1,"args":{"name":"armature"}},
{"ph":"M","name":"thread_name","pid":1,"tid":2,"args":{"name":"control"}},
{"ph":"X","cat":"cycle","name":"cycle","pid":1,"tid":2,"ts":10000.000,"dur":12.345,"args":{"cycle":7,"time_us":10000.000,"steps":true}},
{"ph":"X","cat":"step","name":"Joint\"1","pid":1,"tid":2,"ts":10000.001,"dur":1.002},
{"ph":"X","cat":"messages","name":"messages","pid":1,"tid":2,"ts":12000.000,"dur":0.050,"args":{"cycle":7,"time_us":10000.000,"steps":false,"missing_before":3}},
{"ph":"i","s":"t","cat":"lost","name":"lost","pid":1,"tid":2,"ts":12000.050,"args":{"entries":9}}
]
)");
}

TEST(TimelineWriter, WhatIsASecondOldIsInTheFile) {
  const std::string path = path_of_this_test();
  auto created = TimelineWriter::create(path);
  ASSERT_TRUE(created) << created.error();
  created.value()->add(slice(Kind::kCycle, 1'500'000'000, 10));
  const std::string first = contents(path);
  EXPECT_NE(first.find(R"("ts":1500000.000)"), std::string::npos) << first;
  created.value()->add(slice(Kind::kCycle, 2'499'999'999, 10));
  EXPECT_EQ(contents(path), first);  // many at once are written faster
  created.value()->add(slice(Kind::kCycle, 2'500'000'000, 10));
  EXPECT_NE(contents(path).find(R"("ts":2500000.000)"), std::string::npos);
}

TEST(TimelineWriter, ADiskThatIsFullIsToldAtTheEndWithWhatIsMissing) {
  auto created = TimelineWriter::create("/dev/full");
  ASSERT_TRUE(created) << created.error();
  for (int i = 1; i <= 3; ++i) {
    created.value()->add(slice(Kind::kCycle, i * 1'000'000'000ll, 10));
  }
  const auto closed = created.value()->close();
  ASSERT_FALSE(closed);
  EXPECT_EQ(closed.error(),
            "cannot write '/dev/full': No space left on device: the timeline lacks 3 events");
}

TEST(TimelineWriter, SaysWhyItCannotMakeTheFile) {
  const auto created = TimelineWriter::create("/no/such/folder/trace.json");
  ASSERT_FALSE(created);
  EXPECT_EQ(created.error(),
            "cannot write '/no/such/folder/trace.json': No such file or directory");
}

}  // namespace
}  // namespace armature::record
