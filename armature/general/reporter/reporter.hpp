// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/observing/observer.hpp"
#include "armature/general/reporter/robot_track.hpp"
#include "armature/general/reporter/selection.hpp"
#include "armature/general/reporter/sink.hpp"
#include "armature/record/recording.hpp"
#include "armature/types/enum.hpp"

namespace armature::record {
class CsvWriter;
}

namespace armature::general {

/// For whom the messages of a recording are.
enum class RecordingProfile : std::uint8_t { kNone, kRos2 };
ARMATURE_ENUM(RecordingProfile, kNone, kRos2);
/// Of a recording's chunks.
enum class RecordingCompression : std::uint8_t { kNone, kZstd, kLz4 };
ARMATURE_ENUM(RecordingCompression, kNone, kZstd, kLz4);

/// Records ports, properties and components that it is not connected to (paper 2, section 4.2.3).
///
/// Writers hand their samples over without waiting and are told nothing; in each of its cycles the
/// reporter takes what is there and writes what is older than its last cycle, in the order of time.
/// A port whose samples do not fit into its buffer until then, or a file that cannot be written,
/// loses samples; they are counted in attributes and told in the log. At least every second all is
/// handed to the system, so that a crash costs no more. The same samples give the same bytes.
///
/// It waits for the disk: its activity is to be periodic and to share its thread with nobody.
class Reporter final : public component::Component, private component::Observer {
 public:
  explicit Reporter(std::string name) : Component(std::move(name)), Observer(this) {}

 private:
  /// A source with its tap, and what is to be known between two looks at that.
  struct Track {
    component::Tap* tap;
    bool is_property;
    std::uint64_t dropped = 0;         ///< by the tap, as seen last
    std::uint64_t not_told = 0;        ///< of those
    std::vector<std::byte> last = {};  ///< value, with `on_change`
  };
  struct Taken {
    record::ChannelId channel;
    component::TappedSample sample;
  };

  std::vector<Objection> check_view(
      const std::vector<component::Component*>& components) const override;
  void observe(const component::Surroundings& surroundings) override;
  component::Outcome on_start() override;
  void on_update() override;
  void on_stop() override;
  void on_cleanup() override;

  void object_to_files(const std::vector<component::Component*>& components,
                       std::vector<Objection>& objections) const;
  std::vector<std::string> files() const;
  void object_to_robot(const std::vector<component::Component*>& components,
                       std::vector<Objection>& objections) const;
  void follow_robot(const component::Surroundings& surroundings);
  void follow(const Source& source);
  void follow_port(const component::PortBase& named, std::string name,
                   component::OutputPortBase& output);
  base::Result<void> open_sinks();
  base::Result<void> add_sink(const std::string& path, const Sink::Open& open,
                              const std::vector<record::Channel>& channels);
  record::McapWriter::Options mcap_options() const;
  void write_robot(base::Time time);
  std::string placed(const std::string& file) const;

  void collect();
  void take_all();
  void take_from(record::ChannelId channel);
  void write_before(base::Time end);
  void count_losses();
  void tell_losses();
  void tell_complaint(Sink& sink);
  void tell_end();

  component::Property<std::vector<std::string>> what_{
      this,
      "what",
      {},
      "names of ports, properties and components (their output ports); * is anything but a dot",
      "",
      component::mandatory};
  component::Property<int> every_{this, "every",
                                  1,    "records the first of so many samples of a port",
                                  "",   component::range(1, 1'000'000'000)};
  component::Property<bool> on_change_{this, "on_change", false,
                                       "leaves out samples that equal the one before"};
  component::Property<std::string> file_{this, "file", "", "MCAP file; empty: none"};
  component::Property<RecordingProfile> profile_{
      this, "profile", RecordingProfile::kNone,
      "of the MCAP file: ros2 has messages of ROS 2 in CDR, none JSON"};
  component::Property<RecordingCompression> compression_{
      this, "compression", RecordingCompression::kNone, "of the MCAP file's chunks"};
  component::Property<bool> metadata_{
      this, "metadata", false,
      "the MCAP file tells by which deployment, version and machine it was made"};
  component::Property<std::vector<std::string>> joints_{
      this,
      "joints",
      {},
      "ports with the positions of the joints of the robot that the deployment describes, in their "
      "order: the MCAP file has its frames (/tf) as well; empty: none"};
  component::Property<std::string> csv_{this, "csv", "", "CSV file; empty: none"};
  component::Property<bool> console_{this, "console", false, "prints each sample"};
  component::Property<int> buffer_{this, "buffer",
                                   1000, "samples of a port that wait at most, between two cycles",
                                   "",   component::range(1, 10'000'000)};
  component::Attribute<std::uint64_t> recorded_{this, "recorded", 0, "samples that were taken"};
  component::Attribute<std::uint64_t> dropped_{
      this, "dropped", 0, "samples that found no room, since this component came too late"};
  component::Attribute<std::uint64_t> not_written_{
      this, "not_written", 0, "samples that a file did not take, of all files"};

  std::string folder_;
  std::optional<RobotTrack> robot_;
  std::map<record::ChannelId, std::size_t> robot_ports_;  ///< which of the robot's positions
  std::string robot_trouble_;                             ///< why there is none
  Sink* robot_sink_ = nullptr;
  std::vector<record::Channel> channels_;
  std::vector<Track> tracks_;  ///< of each channel
  std::vector<Sink> sinks_;
  const record::CsvWriter* table_ = nullptr;  ///< in its sink
  std::vector<Taken> pending_;
  base::Time begin_{};
  base::Time last_update_{};
  base::Time last_flush_{};
  bool collecting_ = false;
};

}  // namespace armature::general
