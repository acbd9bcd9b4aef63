// SPDX-License-Identifier: Apache-2.0
// What is always so, whatever breaks: judged on the bus and on the simulated arm.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "armature/can/virtual_bus.hpp"
#include "armature/control/dynamics/inverse_dynamics.hpp"
#include "armature/control/transmission.hpp"
#include "robots/wam/protocol/puck_protocol.hpp"
#include "tests/wam/campaign_arm.hpp"

namespace armature::wam {

/// Reads the torque frames of the host off the bus. Steps are those from one frame to the next, of
/// the joints, which is where they are limited; motors 1 to 4 drive joints 1 to 4 alone, and 5 to 7
/// those of the wrist, so each frame tells of its own joints.
class TorqueWatch {
 public:
  explicit TorqueWatch(CampaignArm& arm)
      : host_(&arm.link().station()),
        number_(arm.hardware().driver().arm().torque_number),
        transmission_(control::Transmission::make(numbers_of(arm).transmission).value()),
        growth_(arm.value<Vector>("WAM", "MaxTorqueGrowth")),
        motors_(arm.joints()),
        joints_(arm.joints()),
        sent_(arm.joints()) {
    for (std::size_t motor = 0; motor < arm.joints(); ++motor) {
      units_per_nm_.push_back(arm.emulator().puck(motor).properties().get(Property::kIpnm));
      most_.push_back(arm.emulator().puck(motor).properties().get(Property::kMt));
    }
    rounding_ = rounding();
  }

  static const ArmNumbers& numbers_of(CampaignArm& arm) {
    return arm.joints() == 4 ? wam4() : wam7();
  }

  void look_at(const can::WireEvent& event) {
    if (event.sender != host_ || event.outcome != can::Outcome::kGood) return;
    const std::optional<Address> address = address_of(event.frame);
    const bool lower = address && address->group && is(*address, Group::kLowerArm);
    if (!lower && !(address && address->group && is(*address, Group::kWrist))) return;
    if (const auto torques = parse_torques(event.frame, number_)) {
      judge(*torques, lower ? 0 : kTorquesPerFrame);
    }
  }

  /// Of MaxTorqueGrowth, without what rounding to puck units makes of it.
  double largest_step() const { return largest_step_; }
  /// Of what the puck gives at most.
  double largest_torque() const { return largest_torque_; }
  std::uint64_t frames() const { return frames_; }

 private:
  static bool is(const Address& address, Group group) {
    return address.to == static_cast<int>(group);
  }

  void judge(const Torques& torques, std::size_t first) {
    ++frames_;
    std::fill(motors_.begin(), motors_.end(), 0.0);
    const std::size_t end = std::min<std::size_t>(first + kTorquesPerFrame, motors_.size());
    for (std::size_t motor = first; motor < end; ++motor) {
      const double units = torques[motor - first];
      largest_torque_ = std::max(largest_torque_, std::abs(units) / most_[motor]);
      motors_[motor] = units / units_per_nm_[motor];
    }
    transmission_.joint_torques(motors_, joints_);
    for (std::size_t joint = first; joint < end; ++joint) {
      const double step = grown(sent_[joint], joints_[joint]) - rounding_[joint];
      largest_step_ = std::max(largest_step_, step / growth_[joint]);
      sent_[joint] = joints_[joint];
    }
  }
  /// Away from 0; back to it there is no limit.
  static double grown(double before, double now) {
    return now > 0.0 ? now - std::max(before, 0.0) : std::min(before, 0.0) - now;
  }
  /// Of each motor one unit [N m].
  Vector rounding() const {
    Vector rounding(sent_.size()), turn(sent_.size()), motors(sent_.size());
    for (std::size_t joint = 0; joint < sent_.size(); ++joint) {
      std::fill(turn.begin(), turn.end(), 0.0);
      turn[joint] = 1.0;
      transmission_.motor_angles(turn, motors);
      for (std::size_t i = 0; i < motors.size(); ++i) {
        rounding[joint] += std::abs(motors[i]) / units_per_nm_[i];
      }
    }
    return rounding;
  }

  const can::VirtualStation* host_;
  int number_;
  control::Transmission transmission_;
  Vector growth_;
  Vector motors_;
  Vector joints_;
  Vector sent_;
  Vector units_per_nm_;
  Vector most_;
  Vector rounding_;
  double largest_step_ = 0.0;
  double largest_torque_ = 0.0;
  std::uint64_t frames_ = 0;
};

/// Looks at the arm that nobody has armed, once it has come to rest. Held by its own controller it
/// stays where it is, but for the way in which it stops what sank; idle or without power it sinks
/// as fast as its weight turns shorted motors (MODEL.md), and no faster.
class RestWatch {
 public:
  explicit RestWatch(CampaignArm& arm)
      : damping_(damping(TorqueWatch::numbers_of(arm))),
        most_(arm.value<Vector>("WAM", "MaxAcceleration")) {
    base::Diagnostics diagnostics;
    const std::string urdf = std::string(WAM "/") + std::string(TorqueWatch::numbers_of(arm).urdf);
    links_ = control::InverseDynamics::load(urdf, {.gravity = {0.0, 0.0, -kGravity}}, diagnostics);
    EXPECT_TRUE(links_) << diagnostics.to_text();
  }

  /// It is carried, or is let rest.
  void forget() { resting_ = false; }
  void look_at(CampaignArm& arm) {
    const bool held = arm.any_puck_drives();
    const Vector positions = arm.positions();
    if (!resting_ || held != held_) begin_at(positions);
    resting_ = true;
    held_ = held;
    if (held) {
      judge_rest(arm, positions);
    } else {
      judge_sinking(positions);
    }
  }

  /// Of the joint that moved most while the arm was held, beyond its way to stop [rad].
  double moved() const { return moved_; }
  /// Of the rate with which its weight turns a joint at most, and 0.01 rad/s.
  double largest_sinking() const { return sinking_; }

 private:
  static constexpr double kCycle = 0.002;  ///< [s]
  static constexpr int kWindow = 50;       ///< cycles
  static constexpr double kStill = 0.01;   ///< [rad/s], what other joints and their stops add

  /// Cycles: three until it is held, two more until torques have grown to its weight.
  static constexpr int kReaction = 5;

  static Vector damping(const ArmNumbers& numbers) {
    Vector all(numbers.joints());
    for (std::size_t joint = 0; joint < all.size(); ++joint) {
      for (std::size_t motor = 0; motor < all.size(); ++motor) {
        const MotorNumbers& winding = numbers.motors[motor];
        const double turns = numbers.transmission.turns[motor * all.size() + joint];
        all[joint] += turns * turns * winding.torque_constant * winding.torque_constant /
                      winding.resistance_ohm;
      }
    }
    return all;
  }
  void begin_at(const Vector& positions) {
    rest_ = positions;
    way_.assign(positions.size(), 0.0);
    cycles_ = sinking_cycles_ = 0;
  }
  /// An arm that sinks falls until it is held, and is then stopped as smoothly as it is told to.
  void judge_rest(CampaignArm& arm, const Vector& positions) {
    const bool falls = cycles_++ < kReaction;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double speed = std::abs(arm.simulated().joint_velocity(i));
      const double way =
          speed * kReaction * kCycle + speed * speed / (2.0 * most_[i % most_.size()]);
      if (falls) way_[i] = std::max(way_[i], way);
      moved_ = std::max(moved_, std::abs(positions[i] - rest_[i]) - way_[i]);
    }
  }
  /// In each tenth of a second: a joint that comes to its stop throws the others for less, and no
  /// joint is slower at once when its weight becomes less.
  void judge_sinking(const Vector& positions) {
    if (sinking_cycles_ == 0) {
      sinks_from_ = positions;
      heaviest_.assign(positions.size(), 0.0);
    }
    Vector weight(positions.size());
    links_->gravity(positions, weight);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      heaviest_[i] = std::max(heaviest_[i], std::abs(weight[i]));
    }
    if (++sinking_cycles_ < kWindow) return;
    sinking_cycles_ = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double most = (heaviest_[i] / damping_[i] + kStill) * kWindow * kCycle;
      sinking_ = std::max(sinking_, std::abs(positions[i] - sinks_from_[i]) / most);
    }
  }

  Vector damping_;
  Vector most_;  ///< [rad/s^2], with which it is stopped
  std::optional<control::InverseDynamics> links_;
  bool resting_ = false;
  bool held_ = false;
  Vector rest_;
  Vector way_;
  int cycles_ = 0;  ///< since it is held
  int sinking_cycles_ = 0;
  Vector sinks_from_;
  Vector heaviest_;  ///< [N m], of each joint in this tenth of a second
  double moved_ = 0.0;
  double sinking_ = 0.0;
};

}  // namespace armature::wam
