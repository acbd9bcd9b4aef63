// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "armature/component/author.hpp"

namespace armature::wam {

/// The motion of all joints home, by the generator's command moveTo: at 0.5 rad/s of all joints
/// together, or slower where its limits demand it.
class WayHome {
 public:
  using Generator = component::CommandCaller<const std::vector<double>&, double>;

  explicit WayHome(Generator& generator) : generator_(generator) {}

  /// What a motion needs to know of the arm.
  struct Arm {
    const std::vector<double>& home;    ///< [rad]
    std::span<const double> positions;  ///< [rad]
    base::Time time;                    ///< of the cycle
  };
  component::Outcome begin(const Arm& arm);
  /// In each cycle while it is under way. One that is refused since another motion comes to rest
  /// first is asked for again, and so is one that would wait for another motion: its time is that
  /// from where the arm is now.
  /// @return whether it has ended: `done` and `reason` say how
  bool follow(const Arm& arm);
  double progress() const { return motion_.progress(); }
  bool done() const { return motion_.stage() == component::CommandStage::kDone; }
  std::string_view reason() const;
  void cancel() { motion_.cancel(); }

 private:
  bool is_refused() const { return motion_.stage() == component::CommandStage::kRefused; }
  bool waits() const { return motion_.stage() == component::CommandStage::kWaiting; }
  void send(const Arm& arm, bool by_limits);

  Generator& generator_;
  component::CommandHandle motion_{component::CallStatus::kNotConnected};
  base::Time asked_at_{};
  bool by_limits_ = false;  ///< asked for the shortest way last
  bool gave_way_ = false;   ///< it is cancelled, since it would have waited
};

}  // namespace armature::wam
