// SPDX-License-Identifier: Apache-2.0
// What `armature run` records: all of it, the same in every run, and readable after a crash.
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "armature/deploy/deployment.hpp"
#include "armature/platform/file.hpp"
#include "armature/record/mcap_reader.hpp"

namespace armature {
namespace {

using record::McapRecording;
using record::RecordedSample;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kPi = 3.14159265358979323846;

/// Starts the program; its output goes to a file.
/// @param largest_file  in bytes; 0: any
pid_t start_program(std::vector<std::string> arguments, const std::string& output,
                    rlim_t largest_file = 0) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  if (largest_file != 0) {
    const rlimit limit{largest_file, largest_file};
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(125);
    ::signal(SIGXFSZ, SIG_IGN);  // it is to be told by an error, as of a full disk
  }
  if (std::freopen(output.c_str(), "w", stdout) == nullptr) ::_exit(126);
  ::dup2(::fileno(stdout), ::fileno(stderr));
  std::vector<char*> raw;
  arguments.insert(arguments.begin(), {PROGRAM, "run"});
  for (std::string& argument : arguments) raw.push_back(argument.data());
  raw.push_back(nullptr);
  ::execv(PROGRAM, raw.data());
  ::_exit(127);
}

class Recorded : public ::testing::Test {
 protected:
  Recorded() {
    folder_ = ::testing::TempDir() + "/recorded_" + std::to_string(::getpid());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~Recorded() override { std::filesystem::remove_all(folder_); }

  std::string in(const std::string& name) const { return folder_ + "/" + name; }

  /// The exit code; what it said is in `said_`.
  int run(const std::vector<std::string>& arguments, rlim_t largest_file = 0) {
    const pid_t child = start_program(arguments, in("said"), largest_file);
    int status = 0;
    ::waitpid(child, &status, 0);
    said_ = platform::read_file(in("said")).value();
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string folder_;
  std::string said_;
};

/// The samples of each channel.
std::map<std::string, std::vector<RecordedSample>> by_channel(const McapRecording& recording) {
  std::map<std::string, std::vector<RecordedSample>> samples;
  for (const RecordedSample& sample : recording.samples) {
    samples[recording.channels[sample.channel].name].push_back(sample);
  }
  return samples;
}

double number(const McapRecording& recording, const RecordedSample& sample) {
  double value = std::nan("");
  const auto read = recording.read(sample, types::type_of<double>(), &value);
  EXPECT_TRUE(read) << read.error();
  return value;
}

/// What `Source` writes at a time: 45 degrees at 2 Hz.
double wave_at(base::Time time) {
  const double seconds = std::chrono::duration<double>(time.time_since_epoch()).count();
  return kPi / 4 * std::sin(2.0 * kPi * 2.0 * seconds);
}

TEST_F(Recorded, InSimulatedTimeEverySampleIsThere) {
  ASSERT_EQ(run({"--sim", "--for", "3s", "--out", in("out"), DEPLOYMENT}), 0) << said_;
  const auto loaded = record::load_mcap(in("out/wave.mcap"));
  ASSERT_TRUE(loaded) << loaded.error();
  const McapRecording& recording = loaded.value();
  auto samples = by_channel(recording);
  ASSERT_EQ(samples["Source.Position"].size(), 300u);
  ASSERT_EQ(samples["Filter.Filtered"].size(), 300u);
  ASSERT_EQ(samples["Watcher.Value"].size(), 300u);
  ASSERT_EQ(samples["Filter.Weight"].size(), 1u);
  EXPECT_EQ(number(recording, samples["Filter.Weight"][0]), 0.2);
  double filtered = 0.0;
  for (std::size_t i = 0; i < 300; ++i) {
    const base::Time time = base::time_from_ns(static_cast<std::int64_t>(i + 1) * 10'000'000);
    filtered += 0.2 * (wave_at(time) - filtered);
    const RecordedSample& source = samples["Source.Position"][i];
    const RecordedSample& filter = samples["Filter.Filtered"][i];
    EXPECT_EQ(source.time, time);
    EXPECT_EQ(source.sequence, i + 1);
    EXPECT_NEAR(number(recording, source), wave_at(time), 1e-14);
    EXPECT_EQ(filter.time, time);
    EXPECT_NEAR(number(recording, filter), filtered, 1e-14);
    EXPECT_EQ(number(recording, samples["Watcher.Value"][i]), number(recording, filter));
  }
  EXPECT_THAT(said_, HasSubstr("901 samples in " + in("out/wave.mcap")));
}

TEST_F(Recorded, TwoSimulatedRunsGiveTheSameBytes) {
  for (const char* name : {"first", "second"}) {
    ASSERT_EQ(run({"--sim", "--for", "7300ms", "--out", in(name), DEPLOYMENT}), 0) << said_;
  }
  for (const char* file : {"/wave.mcap", "/wave.csv"}) {
    const std::string first = platform::read_file(in("first") + file).value();
    EXPECT_GT(first.size(), 20'000u);
    EXPECT_EQ(first, platform::read_file(in("second") + file).value());
  }
}

TEST_F(Recorded, RealTimeThreadsDoNothingForItThatTheyMustNot) {
  if (!std::string_view(ARMATURE_SANITIZER).empty()) GTEST_SKIP() << "it is where the guard is";
  ASSERT_EQ(run({"--guard", "--for", "500ms", "--out", in("out"), DEPLOYMENT}), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("the real-time guard saw 0 violations"));
  EXPECT_TRUE(record::load_mcap(in("out/wave.mcap")));
}

TEST_F(Recorded, AProcessThatIsKilledLeavesAllUpToTheLastWholeChunk) {
  const pid_t child =
      start_program({"--realtime", "off", "--out", in("out"), DEPLOYMENT}, in("said"));
  // Chunks come once a second.
  McapRecording before;
  std::string table_before;
  while ((before.samples.size() < 200 || table_before.empty()) &&
         ::waitpid(child, nullptr, WNOHANG) == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    auto loaded = record::load_mcap(in("out/wave.mcap"), record::Unclosed::kReadToLastChunk);
    if (loaded) before = std::move(loaded).value();
    if (auto table = platform::read_file(in("out/wave.csv"))) table_before = table.value();
  }
  ::kill(child, SIGKILL);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child) << platform::read_file(in("said")).value();
  ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);

  EXPECT_THAT(record::load_mcap(in("out/wave.mcap")).error(), HasSubstr("never closed"));
  const auto loaded = record::load_mcap(in("out/wave.mcap"), record::Unclosed::kReadToLastChunk);
  ASSERT_TRUE(loaded) << loaded.error();
  const McapRecording& recording = loaded.value();
  EXPECT_FALSE(recording.closed);
  EXPECT_GE(recording.samples.size(), before.samples.size());
  auto samples = by_channel(recording);
  std::uint32_t last = 0;
  for (const RecordedSample& sample : samples["Source.Position"]) {
    EXPECT_EQ(sample.sequence, ++last);
    EXPECT_NEAR(number(recording, sample), wave_at(sample.time), 1e-9);
  }
  EXPECT_GT(last, 50u);

  std::istringstream table(platform::read_file(in("out/wave.csv")).value());
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "time_s,Source_Position,Filter_Filtered,Watcher_Value,Filter_Weight");
  std::size_t rows = 0;
  while (std::getline(table, line)) {
    if (line.starts_with('#')) continue;
    EXPECT_EQ(std::ranges::count(line, ','), 4) << line;
    ++rows;
  }
  EXPECT_GT(rows, 50u);
}

TEST_F(Recorded, ADiskThatBecomesFullLeavesAllUpToTheLastWholeChunk) {
  EXPECT_EQ(run({"--sim", "--for", "30s", "--out", in("out"), DEPLOYMENT}, 100'000), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("cannot write '" + in("out/wave.mcap") + "': File too large"));
  const auto loaded = record::load_mcap(in("out/wave.mcap"), record::Unclosed::kReadToLastChunk);
  ASSERT_TRUE(loaded) << loaded.error();
  auto samples = by_channel(loaded.value());
  std::uint32_t last = 0;
  for (const RecordedSample& sample : samples["Source.Position"])
    EXPECT_EQ(sample.sequence, ++last);
  EXPECT_GT(last, 100u);
  EXPECT_LT(last, 3000u);
  const std::string lost = std::to_string(9001 - loaded.value().samples.size());
  EXPECT_THAT(said_, HasSubstr(lost + " samples are not in " + in("out/wave.mcap")));
}

TEST_F(Recorded, ANameThatStandsForNothingIsAnErrorOfTheFileWithItsPlace) {
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  options.document.overrides = {"Reporter.what=[Sorce, Filter.Filtred]"};
  const auto deployment = deploy::load_deployment(DEPLOYMENT, options);
  EXPECT_THAT(deployment.diagnostics.to_text(),
              AllOf(HasSubstr("recorded_wave.yaml:5:3: error: 'Reporter': 'Sorce' cannot be "
                              "recorded (did you mean 'Source'?)"),
                    HasSubstr("did you mean 'Filter.Filtered'?")));
}

TEST_F(Recorded, AFolderThatCannotBeMadeIsNamed) {
  EXPECT_EQ(run({"--sim", "--for", "1s", "--out", "/proc/no/folder", DEPLOYMENT}), 1);
  EXPECT_THAT(said_, HasSubstr("cannot make the folder '/proc/no/folder'"));
}

TEST_F(Recorded, WithoutAFolderFilesGoWhereTheProgramRuns) {
  const std::filesystem::path here = std::filesystem::current_path();
  std::filesystem::current_path(folder_);
  EXPECT_EQ(run({"--sim", "--for", "100ms", DEPLOYMENT}), 0) << said_;
  std::filesystem::current_path(here);
  EXPECT_TRUE(record::load_mcap(in("wave.mcap")));
}

}  // namespace
}  // namespace armature
