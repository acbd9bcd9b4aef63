// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/controllers/base/axis_units.hpp"
#include "armature/controllers/base/max_age.hpp"
#include "armature/controllers/base/missing_answers.hpp"

namespace armature::controllers {

/// What stands between a robot that is switched on and one that moves: nothing is driven before the
/// operator's `arm`, after a start, a fault or a stop. For a periodic activity.
///
/// `arm` raises Settle, at which generators make the measured position the desired one and PIDs
/// forget the past; waits until that is so for every joint, at most for `patience`; then raises
/// Arm, at which joints are held and then let go, and is done when all of them say `Armed`. It
/// fails with the reason, and nobody stays armed, if one of them says `notArmed`, or nothing for
/// `joint_patience`. While all are armed, Rest and Motion say whether they are to stand: whether
/// what is desired rests for 0.1 s. `stop` raises Stop, which is a motion: generators brake
/// smoothly and hold where they come to rest. What is not armed, a joint that homes, hears no Stop:
/// until all are armed `stop` disarms. `disarm` raises Disarm at once: effort 0, brakes
/// applied. If one joint is disarmed, all are.
/// @rt nonblocking, no allocation, O(joints)
class Arming final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void on_stop() override;
  void on_update() override;

  component::Outcome begin_to_arm();
  void wait_for_reference();
  void wait_for_joints();
  void watch();
  void watch_reference();
  void give_up(std::string_view why);
  void joint_does_not_arm(const ComponentName& joint, const component::Reason& why);
  void disarm();
  void stop_moving();
  void tell_armed(bool armed);
  bool is_armed() { return all_armed_.load(std::memory_order_relaxed); }

  std::size_t joints() const { return static_cast<std::size_t>(joints_.get()); }
  bool out_of_patience(double patience) const;
  /// The first joint that does not say `Armed`; joints() if all do.
  std::size_t first_disarmed();
  /// The first that is not desired to rest where it is; joints() if there is none.
  std::size_t first_apart(const std::vector<double>& measured, const std::vector<double>& desired,
                          const std::vector<double>& velocity) const;

  enum class Phase { kDisarmed, kSettling, kArming, kArmed };

  AxisUnits units_{this, AxisUnit::Of::kAxes};
  component::Property<int> joints_{
      this, "joints", 1, "number of joints", "", component::mandatory, component::range(1, 100000)};
  component::Property<double> tolerance_{
      this,
      "tolerance",
      0.01,
      "largest difference of desired and measured position when it arms",
      "",
      component::range(0.0, 1.0),
      component::unit_of(units_.position())};
  component::Property<double> patience_{
      this, "patience", 1.0, "how long to wait for references", "s", component::range(0.0, 60.0)};
  component::Property<double> joint_patience_{
      this, "joint_patience",
      5.0,  "how long to wait for joints, which are held before they are let go",
      "s",  component::range(0.0, 120.0)};
  component::InputPort<std::vector<double>> measured_{
      this, "nAxesSensorPosition",       "measured position of each joint",
      "",   component::size_of(joints_), component::unit_of(units_.position())};
  component::InputPort<std::vector<double>> desired_{
      this, "nAxesDesiredPosition",      "desired position of each joint",
      "",   component::size_of(joints_), component::unit_of(units_.position())};
  component::InputPort<std::vector<double>> desired_velocity_{
      this, "nAxesDesiredVelocity",      "desired velocity of each joint",
      "",   component::size_of(joints_), component::unit_of(units_.velocity())};
  component::InputPorts<bool> joint_armed_{this, "Armed", joints_, "each joint is armed"};

  component::Event<> settle_event_{this, "Settle", "desired := measured; the past is forgotten",
                                   component::occasional};
  component::Event<> arm_event_{this, "Arm", "efforts are passed from now on",
                                component::occasional};
  component::Event<> stop_event_{this, "Stop", "smooth deceleration to rest",
                                 component::occasional};
  component::Event<> disarm_event_{this, "Disarm", "effort 0, brakes applied",
                                   component::occasional};
  component::Event<> rest_event_{this, "Rest", "the armed joints are to stand from now on",
                                 component::occasional};
  component::Event<> motion_event_{this, "Motion", "they may move from now on",
                                   component::occasional};

  component::Command<> arm_{this,
                            "arm",
                            component::serve<&Arming::begin_to_arm>,
                            "lets the joints move from now on",
                            component::by_operator,
                            component::cancelled_by<&Arming::disarm>};
  component::Operation<void()> stop_{
      this, "stop", component::serve<&Arming::stop_moving>,
      "brakes every motion smoothly; armed joints stay armed, what homes does not",
      component::in_own_thread};
  component::Operation<void()> disarm_{this, "disarm", component::serve<&Arming::disarm>,
                                       "emergency stop: effort 0, brakes applied",
                                       component::in_own_thread};
  component::Operation<bool()> is_armed_{this, "isArmed", component::serve<&Arming::is_armed>,
                                         "all joints are armed; answers in any thread"};
  component::Operation<void(const ComponentName&, const component::Reason&)> not_armed_{
      this,
      "notArmed",
      component::serve<&Arming::joint_does_not_arm>,
      "a joint does not arm: nor does the robot",
      component::args("joint", "why"),
      component::in_own_thread};
  component::Attribute<bool> armed_{this, "armed", false, "all joints are armed"};

  Phase phase_ = Phase::kDisarmed;
  std::atomic<bool> all_armed_{false};
  base::Time started_{};
  base::Time since_{};
  std::vector<double> last_desired_;  ///< position of each joint
  base::Time moved_at_{};             ///< when what is desired did not rest last
  bool rests_ = false;                ///< they were told
};

}  // namespace armature::controllers
