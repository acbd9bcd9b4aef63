// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "armature/component/author.hpp"
#include "armature/component/face.hpp"
#include "armature/controllers/base/joint_command.hpp"
#include "armature/controllers/base/limited_effort.hpp"

namespace armature::controllers {

/// The output by which a joint commands its hardware, in the hardware's way.
/// @rt nonblocking, no allocation
/// @thread the component's own
class CommandOutput {
 public:
  CommandOutput(component::Component* owner, JointCommand command) {
    const JointCommandNames& names = names_of(command);
    const auto make = [&](auto& output) {
      output.emplace(owner, names.actuator, "for the hardware", names.unit);
    };
    if (command == JointCommand::kVelocity) {
      make(velocity_);
    } else if (command == JointCommand::kPosition) {
      make(position_);
    } else {
      make(effort_);
    }
  }

  void write(control::LimitedEffort effort) { effort_->write(effort); }
  void write(control::LimitedVelocity velocity) { velocity_->write(velocity); }
  void write(control::LimitedPosition position) { position_->write(position); }

  const component::OutputPortBase& port() const {
    if (velocity_) return face(*velocity_);
    if (position_) return face(*position_);
    return face(*effort_);
  }

 private:
  std::optional<component::OutputPort<control::LimitedEffort>> effort_;
  std::optional<component::OutputPort<control::LimitedVelocity>> velocity_;
  std::optional<component::OutputPort<control::LimitedPosition>> position_;
};

}  // namespace armature::controllers
