// SPDX-License-Identifier: Apache-2.0
// What is kept of a moving head's last seconds when a fault is injected, beside what the Reporter
// recorded of the same run.
#include <filesystem>
#include <map>

#include <gmock/gmock.h>

#include "armature/record/black_box_file.hpp"
#include "armature/record/mcap_reader.hpp"
#include "tests/janus/experiment.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// Moves, loses its bus, and stops; the Reporter records.
class BlackBoxRun {
 public:
  explicit BlackBoxRun(const std::string& name) : folder_(::testing::TempDir() + name) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    Robot robot("../demo/pid.yaml", {}, [this](exec::ApplicationOptions& options) {
      options.output_folder = folder_;
      options.black_box.write = [this](const exec::BlackBoxReport& report) {
        reports.push_back(report);
        const auto written = record::write_black_box(report, folder_);
        EXPECT_TRUE(written) << written.error();
        if (written) files_.push_back(written.value());
        return std::string();
      };
    });
    robot.start_armed();
    EXPECT_EQ(robot.move_to({3.0, 3.0}, 6.0), "");
    robot.run_for(2s);
    static_cast<SimulatedJanus*>(robot.application().find("Cards"))->station().force_bus_off();
    robot.run_for(1s);
    EXPECT_TRUE(robot.application().stop().ok());
  }

  record::McapRecording black_box() const { return load(files_.at(0)); }
  record::McapRecording recording() const { return load(folder_ + "/janus.mcap"); }

  std::vector<exec::BlackBoxReport> reports;

 private:
  static record::McapRecording load(const std::string& path) {
    auto loaded = record::load_mcap(path);
    EXPECT_TRUE(loaded) << loaded.error();
    return loaded ? std::move(loaded).value() : record::McapRecording{};
  }
  std::string folder_;
  std::vector<std::string> files_;
};

/// The last sample of each channel up to `end`.
std::map<std::string, std::string> last_before(const record::McapRecording& recording,
                                               base::Time end) {
  std::map<std::string, std::string> last;
  for (const auto& sample : recording.samples) {
    if (sample.time <= end) last[recording.channels[sample.channel].name] = sample.json;
  }
  return last;
}

TEST(BlackBoxOfJanus, HasOfEachPortWhatTheReporterRecordedLastBeforeTheFault) {
  const BlackBoxRun run("black_box_of_janus");
  ASSERT_FALSE(run.reports.empty());
  EXPECT_THAT(run.reports[0].component, HasSubstr("AIC"));
  EXPECT_THAT(run.reports[0].reason, HasSubstr("the bus of the card is gone"));
  const base::Time fault = run.reports[0].time;
  const auto kept = last_before(run.black_box(), fault);
  const auto recorded = last_before(run.recording(), fault);
  for (const char* channel : {"PID1.Out", "PID2.Out", "Joint1.Position", "Joint2.Position",
                              "Joint1.Armed", "Sensor.sensor", "BridgeRef.reference"}) {
    ASSERT_TRUE(recorded.contains(channel)) << channel;
    ASSERT_TRUE(kept.contains(channel)) << channel;
    EXPECT_EQ(kept.at(channel), recorded.at(channel)) << channel;
  }
}

TEST(BlackBoxOfJanus, TwoRunsHaveTheSame) {
  const BlackBoxRun first("black_box_first");
  const BlackBoxRun second("black_box_second");
  EXPECT_EQ(first.black_box().channels, second.black_box().channels);
  EXPECT_EQ(first.black_box().samples, second.black_box().samples);
}

TEST(BlackBoxOfJanus, GoesBackAtLeastASecond) {
  const BlackBoxRun run("black_box_history");
  const record::McapRecording box = run.black_box();
  ASSERT_FALSE(box.samples.empty());
  base::Time earliest = base::Time::max();
  for (const auto& sample : box.samples) {
    if (box.channels[sample.channel].name == "PID1.Out") earliest = std::min(earliest, sample.time);
  }
  EXPECT_LE(earliest, run.reports[0].time - 1s);
}

}  // namespace
}  // namespace armature::janus
