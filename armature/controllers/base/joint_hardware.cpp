// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/joint_hardware.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "armature/component/face.hpp"

namespace armature::controllers {

/// Of several, a deployment connects one.
class JointHardware::CommandInputs final : public component::Checked {
 public:
  CommandInputs(JointHardware& hardware, std::initializer_list<JointCommand> commands)
      : Checked(&hardware), commands_(commands) {
    for (const JointCommand each : commands_) add(hardware, each);
  }

  void check(component::Check& check) const override {
    if (commands_.size() == 1) return;
    std::string all;
    int connected = 0;
    for (const JointCommand each : commands_) {
      all.append(all.empty() ? "" : ", ").append(names_of(each).actuator);
      if (!check.writers_of(input(each)).empty()) ++connected;
    }
    if (connected == 1) return;
    check.error(std::to_string(connected) + " of its inputs " + all +
                    " have a writer, expected one: that by which its joint commands it",
                "connect the Actuator output of its joint to the input of the same name");
  }

  JointCommand commanded() const {
    const auto connected = std::find_if(commands_.begin(), commands_.end(),
                                        [this](auto each) { return input(each).connected(); });
    return connected == commands_.end() ? commands_.front() : *connected;
  }

 private:
  template <auto kArrived, typename Command>
  void make(JointHardware& hardware, std::optional<component::InputPort<Command>>& input,
            JointCommand command) {
    const JointCommandNames& names = names_of(command);
    if (commands_.size() == 1) {
      input.emplace(&hardware, names.actuator, "to apply from now on", names.unit,
                    component::on_data<kArrived>, component::leads_to_nothing());
    } else {
      input.emplace(&hardware, names.actuator, "to apply from now on", names.unit,
                    component::on_data<kArrived>, component::leads_to_nothing(),
                    component::may_stay_open);
    }
  }
  void add(JointHardware& hardware, JointCommand command) {
    switch (command) {
      case JointCommand::kVelocity:
        return make<&JointHardware::velocity_arrived>(hardware, velocity_, command);
      case JointCommand::kPosition:
        return make<&JointHardware::position_arrived>(hardware, position_, command);
      default:
        return make<&JointHardware::effort_arrived>(
            hardware, efforts_[static_cast<std::size_t>(command)], command);
    }
  }
  const component::InputPortBase& input(JointCommand command) const {
    switch (command) {
      case JointCommand::kVelocity:
        return face(*velocity_);
      case JointCommand::kPosition:
        return face(*position_);
      default:
        return face(*efforts_[static_cast<std::size_t>(command)]);
    }
  }

  std::vector<JointCommand> commands_;
  std::array<std::optional<component::InputPort<control::LimitedEffort>>, 3> efforts_;
  std::optional<component::InputPort<control::LimitedVelocity>> velocity_;
  std::optional<component::InputPort<control::LimitedPosition>> position_;
};

JointHardware::JointHardware(const std::string& name, std::initializer_list<JointCommand> commands,
                             Sensor sensor)
    : Component(name),
      sensor_(sensor == Sensor::kIncremental
                  ? component::OutputPort<double>(this, "DisplacementSensor",
                                                  "of the motor's axis since the reading before",
                                                  "rad")
                  : component::OutputPort<double>(this, "PositionSensor",
                                                  "where the motor's axis is", "rad")),
      sensor_kind_(sensor),
      commands_(std::make_unique<CommandInputs>(*this, commands)) {}

JointHardware::~JointHardware() = default;

/// One may get lost on a bus; after three the joint is driven by what nobody wants any more.
void JointHardware::count_refusals(bool taken) {
  constexpr int kMostRefused = 3;
  refused_ = taken || !permit_ ? 0 : refused_ + 1;
  if (refused_ < kMostRefused) return;
  refused_ = 0;
  fault("it did not take three commands of its joint in a row: look at its bus");
}

JointCommand JointHardware::commanded() const { return commands_->commanded(); }

}  // namespace armature::controllers
