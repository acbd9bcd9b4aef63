// SPDX-License-Identifier: Apache-2.0
// Classes that a robot with simulated drives and one on CAN have in common.
#pragma once

#include <string_view>

namespace armature::cli {

inline constexpr std::string_view kHostTemplate = R"(#pragma once

#include <cstdint>

#include "armature/component/author.hpp"
#include "armature/controllers/base/limited_effort.hpp"
#include "armature/types/struct.hpp"

namespace @name@ {

using namespace armature::component;
using armature::control::DrivePermit;
using armature::control::LimitedEffort;

/// What a drive does, as numbers on the wire have it.
enum class Power : std::uint8_t {
  kOff,   ///< no torque, brake closed
  kHeld,  ///< torque against the closed brake
  kFree,  ///< torque, brake open
};

/// What a drive says in a cycle.
struct @Name@Sample {
  bool fresh = false;  ///< it has answered since it was read last
  int power = 0;       ///< a Power
  double position = 0.0;  ///< [rad] of the joint
};
ARMATURE_STRUCT(@Name@Sample, fresh, power, position);

/// What the drives of all joints are connected to, and their components' peer: to be extended by
/// what it is. Its functions run in real time: they allocate nothing and wait for nobody.
class @Name@Host : public Component {
 public:
  using Component::Component;

 protected:
  virtual @Name@Sample read(int node) = 0;
  virtual bool set_torque(int node, LimitedEffort torque) = 0;
  virtual bool set_power(int node, Power power) = 0;

 private:
  bool energize(int node, bool open_brake, DrivePermit permit) {
    return permit && set_power(node, open_brake ? Power::kFree : Power::kHeld);
  }
  bool make_safe(int node) { return set_power(node, Power::kOff); }

  Operation<@Name@Sample(int)> read_{this,        "readDrive",   serve<&@Name@Host::read>,
                                     "what a drive says in this cycle", args("node"),
                                     in_own_thread};
  Operation<bool(int, LimitedEffort)> set_torque_{
      this, "setTorque", serve<&@Name@Host::set_torque>, "the torque of a drive from now on",
      args("node", "torque [Nm]"), in_own_thread};
  Operation<bool(int, bool, DrivePermit)> energize_{
      this, "energizeDrive", serve<&@Name@Host::energize>,
      "switches a drive on, and opens its brake if `open_brake`",
      args("node", "open_brake", "permit"), in_own_thread};
  Operation<bool(int)> make_safe_{this, "makeDriveSafe", serve<&@Name@Host::make_safe>,
                                  "brakes and switches a drive off", args("node"), in_own_thread};
};

}  // namespace @name@
)";

inline constexpr std::string_view kDriveTemplate = R"(#pragma once

#include "@name@_host.hpp"
#include "armature/base/time.hpp"
#include "armature/controllers/base/joint_hardware.hpp"

namespace @name@ {

/// The drive of one joint, which takes torques and knows where the joint is. It is switched on only
/// when the operator arms, gets only what the joint's limiter let through, and is switched off
/// whenever something stops.
class @Name@Drive final : public armature::controllers::JointHardware {
 public:
  explicit @Name@Drive(const std::string& name)
      : JointHardware(name, {armature::controllers::JointCommand::kTorque}, Sensor::kAbsolute) {}

 private:
  Outcome on_start() override;
  bool actuator_on() override;
  bool actuator_off() override;
  bool actuator_set(LimitedEffort torque) override;
  bool sensor_read() override;
  bool brake_apply() override;
  bool brake_release() override;

  bool energize(Power wanted);
  bool make_safe();

  Property<int> node_{this, "node", 1, "of the drive", "", mandatory, range(1, 127)};
  Property<bool> brake_{this, "Brake", true, "the drive has a brake"};
  OperationCaller<@Name@Sample(int)> read_drive_{this, "readDrive", "has the drive read"};
  OperationCaller<bool(int, LimitedEffort)> set_torque_{this, "setTorque", "sets its torque"};
  OperationCaller<bool(int, bool, DrivePermit)> energize_drive_{this, "energizeDrive",
                                                                "switches it on, opens its brake"};
  OperationCaller<bool(int)> make_drive_safe_{this, "makeDriveSafe", "brakes, switches it off"};
  Attribute<int> power_{this, "power", 0, "0 off, 1 on and braked, 2 on and free"};

  Power wanted_ = Power::kOff;
  armature::base::Time wanted_since_{};
};

}  // namespace @name@
)";

inline constexpr std::string_view kDriveSourceTemplate = R"(#include "@name@_drive.hpp"

#include <chrono>

namespace @name@ {
namespace {

/// As long a drive may take to be as it was told.
constexpr armature::base::Duration kPatience = std::chrono::milliseconds(200);

template <typename Answer>
bool succeeds(const Answer& answer) {
  return answer.status == CallStatus::kDone && answer.value;
}

}  // namespace

Outcome @Name@Drive::on_start() {
  wanted_ = Power::kOff;
  return accepted();
}

/// Once in each sampling period.
bool @Name@Drive::sensor_read() {
  const auto answer = read_drive_(node_);
  if (answer.status != CallStatus::kDone || !answer.value.fresh) return false;
  power_.assign(answer.value.power);
  const bool as_told = answer.value.power == static_cast<int>(wanted_);
  if (!as_told && time() - wanted_since_ > kPatience) fault("the drive is not as it was told to be");
  sensor_.write(answer.value.position);
  return true;
}

bool @Name@Drive::actuator_on() { return energize(brake_ ? Power::kHeld : Power::kFree); }
bool @Name@Drive::actuator_off() { return make_safe(); }
bool @Name@Drive::brake_apply() { return make_safe(); }
bool @Name@Drive::brake_release() { return energize(Power::kFree); }

bool @Name@Drive::actuator_set(LimitedEffort torque) {
  return succeeds(set_torque_(node_, torque));
}

bool @Name@Drive::energize(Power wanted) {
  wanted_ = wanted;
  wanted_since_ = time();
  return succeeds(energize_drive_(node_, wanted == Power::kFree, permit()));
}

bool @Name@Drive::make_safe() {
  if (wanted_ != Power::kOff) wanted_since_ = time();
  wanted_ = Power::kOff;
  return succeeds(make_drive_safe_(node_));
}

}  // namespace @name@
)";

inline constexpr std::string_view kArmTemplate = R"(#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "@name@_host.hpp"
#include "armature/base/as_reason.hpp"
#include "armature/sim/plant.hpp"

namespace @name@ {

/// The arm of the description with ideal drives and brakes, in place of the real one.
class @Name@Plant {
 public:
  /// @param start  [rad] where each joint begins
  /// @param rotor_inertia  [kg m^2] of each motor, at its joint
  static armature::base::Result<@Name@Plant> load(const std::string& file,
                                                   const std::vector<double>& start,
                                                   double rotor_inertia) {
    auto plant = armature::sim::Plant::load(file, {});
    if (!plant) return armature::base::Error{plant.error()};
    armature::sim::Plant::Options options;
    for (std::size_t i = 0; i < plant.value().joints(); ++i) {
      options.armature[std::string(plant.value().name(i))] = rotor_inertia;
    }
    plant = armature::sim::Plant::load(file, options);
    if (!plant) return armature::base::Error{plant.error()};
    if (plant.value().joints() != start.size()) {
      return armature::base::Error{"'start' has " + std::to_string(start.size()) + " numbers, and '" +
                                   file + "' " + std::to_string(plant.value().joints()) +
                                   " joints that move"};
    }
    @Name@Plant arm(std::move(plant).value());
    for (std::size_t i = 0; i < start.size(); ++i) {
      arm.plant_.set_state(i, start[i], 0.0);
      arm.set_power(i, Power::kOff);
    }
    return arm;
  }

  std::size_t joints() const { return power_.size(); }
  double position(std::size_t joint) const { return plant_.position(joint); }
  Power power(std::size_t joint) const { return power_[joint]; }

  void set_torque(std::size_t joint, double torque) {
    plant_.set_effort(joint, power_[joint] == Power::kOff ? 0.0 : torque);
  }
  void set_power(std::size_t joint, Power power) {
    power_[joint] = power;
    plant_.set_brake(joint, power == Power::kFree ? 0.0 : kHoldingTorque);
    if (power == Power::kOff) plant_.set_effort(joint, 0.0);
  }
  void step(armature::base::Duration dt) { plant_.step(dt); }

 private:
  explicit @Name@Plant(armature::sim::Plant plant)
      : plant_(std::move(plant)), power_(plant_.joints(), Power::kOff) {}

  static constexpr double kHoldingTorque = 1000.0;  // Nm

  armature::sim::Plant plant_;
  std::vector<Power> power_;
};

}  // namespace @name@
)";

}  // namespace armature::cli
