// SPDX-License-Identifier: Apache-2.0
// What the Reporter records, and what it refuses to.

#include "tests/reporter/reporting.hpp"

namespace armature::controllers {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(Reporting, EverySampleIsThereWithItsTimeAndNumber) {
  record({"Writer.Number"});
  run(475ms);
  const McapRecording recording = load();
  ASSERT_EQ(recording.channels.size(), 1u);
  EXPECT_EQ(recording.channels[0], (record::RecordedChannel{"Writer.Number", "double", "double",
                                                            "V", "half of the cycles"}));
  ASSERT_EQ(recording.samples.size(), 475u);
  for (std::size_t i = 0; i < 475; ++i) {
    const record::RecordedSample& sample = recording.samples[i];
    EXPECT_EQ(sample.sequence, i + 1);
    EXPECT_EQ(base::to_ns(sample.time), static_cast<std::int64_t>(i + 1) * 1'000'000);
    EXPECT_EQ(value<double>(recording, sample), 0.5 * static_cast<double>(i + 1));
  }
  EXPECT_EQ(count("recorded"), 475u);
  EXPECT_EQ(count("dropped"), 0u);
  EXPECT_EQ(count("not_written"), 0u);
  EXPECT_THAT(log, Contains(StartsWith("475 samples in ")));
}

TEST_F(Reporting, VectorsAndStructsAreRecordedAsTheyAre) {
  record({"Writer.Vector", "Writer.Twist"});
  run(3ms);
  const McapRecording recording = load();
  ASSERT_EQ(recording.samples.size(), 6u);  // in the order of time, then of the names
  EXPECT_EQ(value<std::vector<double>>(recording, recording.samples[4]),
            (std::vector<double>{3.0, -3.0}));
  EXPECT_EQ(value<Twist>(recording, recording.samples[5]), (Twist{3.0, 6}));
}

TEST_F(Reporting, TheTableHasARowForEachTime) {
  set("what", std::vector<std::string>{"Writer.Number", "Writer.Vector"});
  set("csv", std::string("run.csv"));
  run(120ms);
  EXPECT_THAT(content("run.csv"), AllOf(StartsWith("time_s,Writer_Number,Writer_Vector_0,"),
                                        HasSubstr("\n0.001000000,0.5,1,-1\n0.002000000,1,2,-2\n"),
                                        EndsWith("\n0.120000000,60,120,-120\n")));
}

TEST_F(Reporting, OfEverySomanySamplesTheFirstIsRecorded) {
  record({"Writer.Number"});
  set("every", 100);
  run(250ms);
  const McapRecording recording = load();
  ASSERT_EQ(recording.samples.size(), 3u);
  EXPECT_EQ(recording.samples[2].sequence, 201u);
  EXPECT_EQ(value<double>(recording, recording.samples[2]), 100.5);
}

TEST_F(Reporting, OnChangeWhatEqualsTheSampleBeforeIsLeftOut) {
  record({"Writer.Slow"});
  set("on_change", true);
  run(12ms);
  const McapRecording recording = load();
  ASSERT_EQ(recording.samples.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    const record::RecordedSample& sample = recording.samples[static_cast<std::size_t>(i)];
    EXPECT_EQ(sample.sequence, i == 0 ? 1u : static_cast<unsigned>(4 * i));
    EXPECT_EQ(value<int>(recording, sample), i);
  }
}

TEST_F(Reporting, AnInputIsRecordedAsItsWriterWritesIt) {
  record({"Reader.In", "Reader.Open"});
  run(5ms);
  const McapRecording recording = load();
  ASSERT_EQ(recording.channels.size(), 1u);
  EXPECT_EQ(recording.channels[0].name, "Reader.In");
  EXPECT_EQ(recording.samples.size(), 5u);
  EXPECT_THAT(log, Contains(HasSubstr("Reader.Open has no writer")));
}

TEST_F(Reporting, PropertiesAreRecordedAtTheStartAndWhenTheyChange) {
  record({"Writer.Gain", "Writer.Note"});
  start();
  application->run_for(20ms);
  ASSERT_TRUE(application->set_property("Writer", "Gain", types::Value::of(3.5)));
  application->run_for(20ms);
  ASSERT_TRUE(application->set_property("Writer", "Gain", types::Value::of(3.5)));
  ASSERT_TRUE(
      application->set_property("Writer", "Note", types::Value::of(std::string("changed"))));
  application->run_for(20ms);
  application->stop();
  const McapRecording recording = load();
  ASSERT_EQ(recording.samples.size(), 4u);
  const auto& samples = recording.samples;
  EXPECT_EQ(base::to_ns(samples[0].time), 0);
  EXPECT_EQ(value<double>(recording, samples[0]), 2.5);
  EXPECT_EQ(value<std::string>(recording, samples[1]), "as built");
  EXPECT_EQ(base::to_ns(samples[2].time), 20'000'000);
  EXPECT_EQ(value<double>(recording, samples[2]), 3.5);
  EXPECT_EQ(base::to_ns(samples[3].time), 40'000'000);
  EXPECT_EQ(value<std::string>(recording, samples[3]), "changed");
}

TEST_F(Reporting, ANameThatStandsForNothingIsFoundByCheck) {
  record({"Writer.Numbr", "Writer.Vector"});
  EXPECT_THAT(make().check().to_text(),
              AllOf(HasSubstr("'Reporter': 'Writer.Numbr' cannot be recorded"),
                    HasSubstr("did you mean 'Writer.Number'?")));
}

TEST_F(Reporting, ARecordingWithoutSourcesOrFileIsFoundByCheck) {
  set("what", std::vector<std::string>{});
  EXPECT_THAT(make().check().to_text(), AllOf(HasSubstr("the property 'what' names nothing"),
                                              HasSubstr("its recording goes nowhere")));
}

TEST_F(Reporting, TwoRecordingsInOneFileAreFoundByCheck) {
  record({"Writer"});
  set("csv", std::string("run.mcap"));
  add_reporter("Second");
  set("what", std::vector<std::string>{"Writer"}, "Second");
  set("file", std::string("run.mcap"), "Second");
  EXPECT_THAT(make().check().to_text(),
              AllOf(HasSubstr("'Reporter': file and csv are both 'run.mcap'"),
                    HasSubstr("'Second': 'Reporter' writes 'run.mcap' too")));
}

TEST_F(Reporting, AReporterNeedsAPeriod) {
  record({"Writer"});
  blueprint.components.back().activity = exec::Activity::triggered();
  EXPECT_THAT(make().check().to_text(), HasSubstr("'Reporter' watches others and needs a period"));
}

TEST_F(Reporting, TheSameRunGivesTheSameBytes) {
  record({"Writer", "Writer.Gain"});
  set("csv", std::string("run.csv"));
  run(2345ms);
  const std::string mcap = content("run.mcap");
  const std::string csv = content("run.csv");
  ASSERT_GT(mcap.size(), 100'000u);
  application.reset();
  blueprint = {};
  writer = &blueprint.add<Writer>("Writer", exec::Activity::periodic(1ms));
  add_reporter("Reporter");
  record({"Writer", "Writer.Gain"});
  set("csv", std::string("run.csv"));
  run(2345ms);
  EXPECT_EQ(content("run.mcap"), mcap);
  EXPECT_EQ(content("run.csv"), csv);
}

TEST_F(Reporting, EachRunOfAnApplicationIsRecordedAnew) {
  record({"Writer.Number", "Writer.Gain"});
  run(100ms);
  ASSERT_EQ(load().samples.size(), 101u);
  ASSERT_TRUE(application->start().ok());
  application->run_for(10ms);
  application->stop();
  EXPECT_EQ(load().samples.size(), 11u);
  EXPECT_EQ(count("recorded"), 11u);
}

TEST_F(Reporting, AStartThatFailsBeforeItLooksLeavesNothingBehind) {
  record({"Writer.Number"});
  run(100ms);
  writer->refuses = true;
  EXPECT_THAT(application->start().to_text(), HasSubstr("'Writer' refuses to configure: as told"));
  EXPECT_EQ(load().samples.size(), 100u);
  writer->refuses = false;
  ASSERT_TRUE(application->start().ok());
}

TEST_F(Reporting, TheConsoleHasALineForEachSample) {
  set("what", std::vector<std::string>{"Writer.Number"});
  set("console", true);
  ::testing::internal::CaptureStdout();
  run(2ms);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(),
            "0.001000000 Writer.Number 0.5 V\n0.002000000 Writer.Number 1 V\n");
}

}  // namespace
}  // namespace armature::controllers
