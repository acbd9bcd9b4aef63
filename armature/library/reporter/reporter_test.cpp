// SPDX-License-Identifier: Apache-2.0
#include "armature/library/reporter/reporter.hpp"

#include <atomic>
#include <filesystem>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "armature/exec/application.hpp"
#include "armature/platform/file.hpp"
#include "armature/record/mcap_reader.hpp"

namespace armature::library {
namespace {

using namespace std::chrono_literals;
using component::Component;
using record::McapRecording;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

struct Twist {
  double forward = 0.0;
  int turns = 0;
  bool operator==(const Twist&) const = default;
};
ARMATURE_STRUCT(Twist, (forward, "m/s", "speed"), turns);

/// In its n-th cycle writes n / 2, [n, -n] and {n, 2 n}, and every fourth time another `Slow`;
/// `Twice` twice.
class Writer final : public Component {
 public:
  using Component::Component;
  std::atomic<int> cycles{0};

 private:
  void on_update() override {
    const int n = ++cycles;
    number_.write(0.5 * n);
    pair_[0] = n;
    pair_[1] = -n;
    vector_.write(pair_);
    twist_.write({1.0 * n, 2 * n});
    slow_.write(n / 4);
    twice_.write(n);
    twice_.write(-n);
  }
  component::OutputPort<double> number_{this, "Number", "half of the cycles", "V"};
  component::OutputPort<std::vector<double>> vector_{this, "Vector", "", "rad",
                                                     component::fixed_size(2)};
  component::OutputPort<Twist> twist_{this, "Twist", ""};
  component::OutputPort<int> slow_{this, "Slow", ""};
  component::OutputPort<int> twice_{this, "Twice", ""};
  component::Property<double> gain_{this, "Gain", 2.5, "", "", component::changeable_while_running};
  component::Property<std::string> note_{this, "Note", "as built",
                                         "",   "",     component::changeable_while_running};
  std::vector<double> pair_{0.0, 0.0};
};

class Reader final : public Component {
 public:
  using Component::Component;

 private:
  component::InputPort<double> in_{this, "In", "what it reads", "V"};
  component::InputPort<double> open_{this, "Open", "", "V", component::may_stay_open};
};

/// An application in which `Writer` runs every millisecond and `Reporter` every 50 ms.
class Reporting : public ::testing::Test {
 protected:
  Reporting() {
    static std::atomic<int> count{0};
    options.simulated = true;
    options.log = [this](const rt::LogRecord& record) { log.push_back(record.message()); };
    options.output_folder = ::testing::TempDir() + "/reporter_" + std::to_string(::getpid()) + "_" +
                            std::to_string(++count);
    std::filesystem::create_directories(options.output_folder);
    writer = &blueprint.add<Writer>("Writer", exec::Activity::periodic(1ms));
    blueprint.add<Reader>("Reader", exec::Activity::periodic(10ms));
    blueprint.connect("Writer.Number", "Reader.In");
    add_reporter("Reporter");
  }
  ~Reporting() override {
    application.reset();
    std::filesystem::remove_all(options.output_folder);
  }

  void add_reporter(const std::string& name) {
    blueprint.add<Reporter>(name, exec::Activity::periodic(50ms));
  }
  template <typename T>
  void set(const std::string& property, const T& value, const std::string& reporter = "Reporter") {
    for (const exec::ComponentEntry& entry : blueprint.components) {
      if (entry.component->name() != reporter) continue;
      for (auto* each : entry.component->interface().properties) {
        if (each->name() == property) {
          ASSERT_TRUE(each->set(types::Value::of(value)));
        }
      }
    }
  }
  void record(const std::vector<std::string>& what) {
    set("what", what);
    set("file", std::string("run.mcap"));
  }
  exec::Application& make() {
    application = std::make_unique<exec::Application>(std::move(blueprint), options);
    return *application;
  }
  void start() {
    const base::Diagnostics diagnostics = make().start();
    ASSERT_TRUE(diagnostics.ok()) << diagnostics.to_text();
  }
  void run(base::Duration duration) {
    start();
    application->run_for(duration);
    const base::Diagnostics diagnostics = application->stop();
    EXPECT_TRUE(diagnostics.ok()) << diagnostics.to_text();
  }
  std::string path(const std::string& file) const { return options.output_folder + "/" + file; }
  std::string content(const std::string& file) const {
    return platform::read_file(path(file)).value();
  }
  McapRecording load(const std::string& file = "run.mcap") const {
    auto recording = record::load_mcap(path(file));
    EXPECT_TRUE(recording) << recording.error();
    return std::move(recording).value();
  }
  std::uint64_t count(const std::string& attribute) {
    return *application->value_of("Reporter", attribute).value().get_if<std::uint64_t>();
  }

  exec::Blueprint blueprint;
  exec::ApplicationOptions options;
  Writer* writer;
  std::vector<std::string> log;
  std::unique_ptr<exec::Application> application;
};

template <typename T>
T value(const McapRecording& recording, const record::RecordedSample& sample) {
  T read{};
  const auto done = recording.read(sample, types::type_of<T>(), &read);
  EXPECT_TRUE(done) << done.error();
  return read;
}

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

TEST_F(Reporting, OfTwoSamplesAtOneTimeTheTableHasTheLastAndTheOthersAreCounted) {
  record({"Writer.Twice"});
  set("csv", std::string("run.csv"));
  run(3ms);
  EXPECT_EQ(load().samples.size(), 6u);
  EXPECT_THAT(content("run.csv"), EndsWith("\n0.001000000,-1\n0.002000000,-2\n0.003000000,-3\n"));
  EXPECT_THAT(log, Contains(StartsWith("3 samples are not in the table")));
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
  EXPECT_THAT(log, Contains(HasSubstr("nobody writes Reader.Open")));
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

TEST_F(Reporting, ANameThatStandsForNothingIsFoundByCheck) {
  record({"Writer.Numbr", "Writer.Vector"});
  EXPECT_THAT(make().check().to_text(),
              AllOf(HasSubstr("'Reporter': 'Writer.Numbr' is nothing that can be recorded"),
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
  EXPECT_THAT(make().check().to_text(), HasSubstr("'Reporter' looks at others in a period"));
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

TEST_F(Reporting, TheConsoleHasALineForEachSample) {
  set("what", std::vector<std::string>{"Writer.Number"});
  set("console", true);
  ::testing::internal::CaptureStdout();
  run(2ms);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(),
            "0.001000000 Writer.Number 0.5 V\n0.002000000 Writer.Number 1 V\n");
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
}  // namespace armature::library
