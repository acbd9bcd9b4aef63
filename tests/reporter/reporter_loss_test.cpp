// SPDX-License-Identifier: Apache-2.0
// What the Reporter loses, and who is told: slow, full and hanging disks, faults, pauses.
#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/reporter/reporting.hpp"

namespace armature::controllers {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(Reporting, OfTwoSamplesAtOneTimeTheTableHasTheLastAndTheOthersAreCounted) {
  record({"Writer.Twice"});
  set("csv", std::string("run.csv"));
  run(3ms);
  EXPECT_EQ(load().samples.size(), 6u);
  EXPECT_THAT(content("run.csv"), EndsWith("\n0.001000000,-1\n0.002000000,-2\n0.003000000,-3\n"));
  EXPECT_THAT(log, Contains(StartsWith("3 samples are not in the table")));
}

TEST_F(Reporting, WhatFindsNoRoomIsCountedAndNamed) {
  record({"Writer.Number", "Writer.Slow"});
  set("buffer", 20);
  set("every", 2);
  run(100ms);
  // Of 25 samples of each port in 50 ms there was room for 20.
  EXPECT_EQ(count("dropped"), 20u);
  EXPECT_EQ(count("recorded"), 80u);
  EXPECT_THAT(log, Contains("dropped 10 samples of Writer.Number: more than 20 came between two "
                            "cycles"));
  EXPECT_THAT(log, Contains(HasSubstr("dropped 10 samples of Writer.Slow")));
  EXPECT_EQ(writer->cycles, 100);
  const McapRecording recording = load();
  ASSERT_EQ(recording.samples.size(), 80u);
  EXPECT_EQ(recording.samples[39].sequence, 39u);
  EXPECT_EQ(recording.samples[40].sequence, 51u);  // the gap says where
}

TEST_F(Reporting, AFullDiskLosesSamplesWhichAreCountedAndNothingElse) {
  set("what", std::vector<std::string>{"Writer.Number"});
  set("csv", std::string("/dev/full"));
  set("file", std::string("run.mcap"));
  run(3s);
  EXPECT_EQ(writer->cycles, 3000);
  EXPECT_EQ(count("recorded"), 3000u);
  EXPECT_EQ(count("not_written"), 3000u);
  EXPECT_EQ(load().samples.size(), 3000u);
  EXPECT_THAT(log, Contains(StartsWith("cannot write '/dev/full': No space left on device; samples "
                                       "that are lost by now: ")));
  EXPECT_THAT(log, Contains("3000 samples are not in /dev/full"));
}

TEST_F(Reporting, AFileThatCannotBeMadeIsARefusalToStart) {
  record({"Writer"});
  set("file", std::string("/no/such/folder/run.mcap"));
  EXPECT_THAT(make().start().to_text(),
              HasSubstr("'Reporter' refuses to start: cannot write '/no/such/folder/run.mcap': No "
                        "such file or directory"));
  EXPECT_EQ(writer->state(), component::State::kPreOperational);
}

TEST_F(Reporting, WhileItRunsAllButTheLastSecondCanBeRead) {
  record({"Writer.Number"});
  set("csv", std::string("run.csv"));
  start();
  application->run_for(2500ms);
  const auto recording = record::load_mcap(path("run.mcap"), record::Unclosed::kReadToLastChunk);
  ASSERT_TRUE(recording) << recording.error();
  EXPECT_FALSE(recording.value().closed);
  EXPECT_EQ(recording.value().samples.size(), 1949u);  // at 2 s what was before 1.95 s
  EXPECT_THAT(content("run.csv"), EndsWith("\n1.948000000,974\n"));
}

TEST_F(Reporting, WhatIsWrittenWhileItIsStoppedIsNotRecordedNorLost) {
  record({"Writer.Number"});
  set("buffer", 60);
  start();
  application->run_for(100ms);
  ASSERT_TRUE(application->stop_component("Reporter"));
  application->run_for(100ms);
  ASSERT_TRUE(application->start_component("Reporter"));
  application->run_for(100ms);
  application->stop();
  const McapRecording recording = load();
  ASSERT_EQ(recording.samples.size(), 200u);
  EXPECT_EQ(recording.samples[99].sequence, 100u);
  EXPECT_EQ(base::to_ns(recording.samples[100].time), 201'000'000);
  EXPECT_EQ(count("dropped"), 0u);
}

TEST_F(Reporting, AFaultOfTheWriterLeavesTheRecordingComplete) {
  record({"Writer.Number"});
  start();
  application->run_for(30ms);
  writer->fault("test");
  application->run_for(30ms);
  application->stop();
  EXPECT_EQ(load().samples.size(), 30u);
}

TEST_F(Reporting, InRealThreadsEverySampleIsRecordedOrCounted) {
  options.simulated = false;
  record({"Writer.Number"});
  start();
  while (writer->cycles < 100) application->run_for(10ms);
  application->stop();
  const McapRecording recording = load();
  std::uint32_t last = 0;
  for (const record::RecordedSample& sample : recording.samples) {
    EXPECT_GT(sample.sequence, last);
    last = sample.sequence;
    EXPECT_EQ(value<double>(recording, sample), 0.5 * last);
  }
  const auto cycles = static_cast<std::uint64_t>(writer->cycles);
  EXPECT_EQ(count("recorded") + count("dropped"), cycles);
  EXPECT_EQ(recording.samples.size(), count("recorded"));
}

TEST_F(Reporting, ADiskThatHangsHoldsUpNoCycleOfTheWriter) {
  options.simulated = false;
  const std::string pipe = path("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);  // which does not read for now
  ASSERT_GE(reader, 0);
  set("what", std::vector<std::string>{"Writer.Number"});
  set("csv", pipe);
  set("buffer", 50);
  blueprint.components[0].activity = exec::Activity::periodic(100us);
  start();
  const int more_than_a_pipe_holds = 8000;
  while (writer->cycles < more_than_a_pipe_holds) application->run_for(10ms);
  std::atomic<bool> done{false};
  std::thread reads([&] {
    std::vector<char> bytes(1 << 16);
    while (!done) {
      if (::read(reader, bytes.data(), bytes.size()) <= 0) std::this_thread::yield();
    }
  });
  application->run_for(100ms);
  const base::Diagnostics stopped = application->stop();
  done = true;
  reads.join();
  ::close(reader);
  EXPECT_TRUE(stopped.ok()) << stopped.to_text();
  EXPECT_GT(count("dropped"), 0u);
  EXPECT_EQ(count("recorded") + count("dropped"), static_cast<std::uint64_t>(writer->cycles));
  EXPECT_THAT(log, Contains(AllOf(StartsWith("dropped "), HasSubstr("of Writer.Number"))));
}

TEST_F(Reporting, ASharedThreadIsWarnedOf) {
  options.simulated = false;
  record({"Writer.Number"});
  for (const std::size_t i : {0u, 2u}) {
    blueprint.components[i].activity = exec::Activity::periodic(1ms);
    blueprint.components[i].activity.thread = "shared";
  }
  start();
  while (writer->cycles < 20) application->run_for(5ms);
  application->stop();
  EXPECT_THAT(log, Contains(HasSubstr("Writer waits for the disk as well")));
  EXPECT_EQ(count("recorded") + count("dropped"), static_cast<std::uint64_t>(writer->cycles));
}

}  // namespace
}  // namespace armature::controllers
