// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/component/author.hpp"
#include "armature/control/dynamics/robot_frames.hpp"
#include "armature/record/mcap_writer.hpp"

namespace armature::general {

/// A robot in a recording: its frames, and for ROS 2 its joint states, as they follow from recorded
/// positions of its joints.
class RobotTrack {
 public:
  /// Between two samples; its joints' ports are recorded at each write.
  static constexpr base::Duration kInterval = std::chrono::milliseconds(20);

  /// A sample of one of its channels.
  struct Sample {
    std::size_t channel = 0;  ///< which of `channels`
    std::vector<std::byte> value;
  };

  /// By the first component that names a description (`robot_description`, `base_link`,
  /// `tip_link`).
  /// @param positions  of ports, in the order of the joints: numbers, or lists of them; one port
  ///                   may have other numbers behind them
  static base::Result<RobotTrack> make(const std::vector<component::Component*>& components,
                                       std::vector<types::Value> positions,
                                       record::McapWriter::Profile profile);

  /// `/tf`; for ROS 2 also `/joint_states`.
  std::vector<record::Channel> channels() const;
  /// @param port   which of the positions
  /// @param value  as types::encode has it
  void take(std::size_t port, const std::vector<std::byte>& value);
  /// What is to be written of `time`: at most every kInterval, once all positions have come.
  std::vector<Sample> due(base::Time time);

 private:
  RobotTrack(control::RobotFrames frames, std::vector<std::size_t> moving,
             std::vector<types::Value> positions, record::McapWriter::Profile profile);

  bool is_for_ros() const { return profile_ == record::McapWriter::Profile::kRos2; }
  std::size_t numbers() const;
  std::vector<double> joint_positions() const;
  std::vector<control::FramePose> poses() const;

  control::RobotFrames frames_;
  std::vector<std::size_t> moving_;
  std::vector<types::Value> positions_;
  std::vector<bool> came_;
  record::McapWriter::Profile profile_;
  std::optional<base::Time> last_;
};

}  // namespace armature::general
