// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "armature/component/author.hpp"
#include "armature/control/joint_limiter.hpp"

namespace armature::controllers {

/// What a Joint asks of its hardware, which is the peer that its PeerName names (JointHardware says
/// what each of it means). What answers with a boolean has succeeded if it was served and says so.
/// @rt nonblocking but for the hardware's answers, no allocation
/// @thread the component's own
class JointPeer {
 public:
  /// @param name   of the peer; outlives this, as all
  /// @param brake  it has one
  JointPeer(component::Component* owner, const component::Property<std::string>& name,
            const component::Property<bool>& brake)
      : read_(owner, "sensorRead", "has the sensors read", component::from(name)),
        is_as_told_(owner, "isAsTold", "actuator and brake have done what they were told last",
                    component::from(name), component::optional),
        position_known_(owner, "positionKnown", "nothing that moved was lost",
                        component::from(name), component::optional),
        position_exact_(owner, "positionExact", "no sample was lost", component::from(name),
                        component::optional),
        home_by_itself_(owner, "homeByItself", "has it home", component::from(name),
                        component::optional),
        homing_stage_(owner, "homingStage", "how far it is", component::from(name),
                      component::optional),
        is_homed_(owner, "isHomed", "its position is that of home", component::from(name),
                  component::optional),
        begin_search_(owner, "beginHoming", "the joint looks for its position",
                      component::from(name), component::optional),
        find_position_(owner, "positionFound", "the joint has found its position",
                       component::from(name), component::optional),
        since_index_(owner, "sinceIndex", "of its index mark", component::from(name),
                     component::optional),
        doubt_position_(owner, "doubtPosition", "has it ask for position_confirmed",
                        component::from(name), component::optional),
        actuator_on_(owner, "actuatorOn", "switches the actuator on", component::from(name)),
        actuator_off_(owner, "actuatorOff", "switches the actuator off", component::from(name)),
        apply_brake_(owner, "brakeApply", "applies the brake", component::from(name),
                     component::only_if(brake)),
        release_brake_(owner, "brakeRelease", "releases the brake", component::from(name),
                       component::only_if(brake)) {}

  bool read() { return succeeds(read_); }
  bool actuator_on(control::DrivePermit permit) { return succeeds(actuator_on_, permit); }
  bool actuator_off() { return succeeds(actuator_off_); }
  bool apply_brake() { return succeeds(apply_brake_); }
  bool release_brake(control::DrivePermit permit) { return succeeds(release_brake_, permit); }
  bool is_as_told() { return !is_as_told_.bound() || succeeds(is_as_told_); }

  // Where it is. Hardware that does not speak of it has lost nothing, and asks nobody.
  bool knows_position() { return !position_known_.bound() || succeeds(position_known_); }
  bool is_exact() { return succeeds(position_exact_); }
  bool doubt_position() { return succeeds(doubt_position_); }

  // Of hardware that homes by itself.
  bool homes() const { return home_by_itself_.bound() && homing_stage_.bound(); }
  bool tells_of_home() const { return is_homed_.bound(); }
  bool is_homed() { return succeeds(is_homed_); }
  bool home(control::DrivePermit permit) { return succeeds(home_by_itself_, permit); }
  /// None if it does not answer.
  std::optional<int> homing_stage() { return answer_of(homing_stage_); }

  // For a joint that homes by itself.
  /// @param most_effort  of the motor; infinite: hardware that knows nothing of it will do
  bool begin_search(control::DrivePermit permit, double most_effort) {
    return begin_search_.bound() ? succeeds(begin_search_, permit, most_effort)
                                 : !std::isfinite(most_effort);
  }
  bool find_position(control::DrivePermit permit) {
    return !find_position_.bound() || succeeds(find_position_, permit);
  }
  /// Motion of the motor's axis since its index mark; none if it passed none.
  std::optional<double> since_index() {
    const std::optional<double> since = answer_of(since_index_);
    return since && std::isfinite(*since) ? since : std::nullopt;
  }

 private:
  template <typename Result, typename... Arguments>
  static std::optional<Result> answer_of(component::OperationCaller<Result(Arguments...)>& call,
                                         Arguments... arguments) {
    const component::CallResult<Result> answer = call(arguments...);
    if (answer.status != component::CallStatus::kDone) return std::nullopt;
    return answer.value;
  }
  template <typename... Arguments>
  static bool succeeds(component::OperationCaller<bool(Arguments...)>& call,
                       Arguments... arguments) {
    return answer_of(call, arguments...).value_or(false);
  }

  component::OperationCaller<bool()> read_;
  component::OperationCaller<bool()> is_as_told_;
  component::OperationCaller<bool()> position_known_;
  component::OperationCaller<bool()> position_exact_;
  component::OperationCaller<bool(control::DrivePermit)> home_by_itself_;
  component::OperationCaller<int()> homing_stage_;
  component::OperationCaller<bool()> is_homed_;
  component::OperationCaller<bool(control::DrivePermit, double)> begin_search_;
  component::OperationCaller<bool(control::DrivePermit)> find_position_;
  component::OperationCaller<double()> since_index_;
  component::OperationCaller<bool()> doubt_position_;
  component::OperationCaller<bool(control::DrivePermit)> actuator_on_;
  component::OperationCaller<bool()> actuator_off_;
  component::OperationCaller<bool()> apply_brake_;
  component::OperationCaller<bool(control::DrivePermit)> release_brake_;
};

}  // namespace armature::controllers
