// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/can/link.hpp"
#include "robots/wam/arm_numbers.hpp"
#include "robots/wam/emulator/arm_motors.hpp"
#include "robots/wam/emulator/emulator.hpp"

namespace armature::wam {

/// The emulated arm in the host's own thread, which lets time pass there whenever it looks.
class EmulatedLink final : public can::Link {
 public:
  enum class Time {
    kSimulated,  ///< waiting takes no time: the emulator runs ahead of the application's clock
    kReal,       ///< on the monotonic clock
  };
  struct Config {
    ArmSimulation::Config arm;
    Time time = Time::kSimulated;
    base::Time begin{};  ///< on the application's clock
  };

  /// In E-stop, with the button pressed.
  static base::Result<std::unique_ptr<EmulatedLink>> make(const ArmNumbers& numbers,
                                                          const Config& config);

  can::Bus& bus() override { return *host_; }
  bool open(can::BusOptions options, base::Diagnostics& diagnostics) override;
  /// The application's clock may stand where it stood while the conversation before the run took
  /// seconds of the emulator's.
  void begin_run(base::Time time) override;
  void begin_cycle(base::Time time) override;
  base::Time now() override;
  void wait_for_news(base::Time deadline) override;

  /// The operator carries the arm home, which lies without power or is braked, and holds it there
  /// until `let_go`.
  void hold_at_home() { held_ = true; }
  void let_go() { held_ = false; }
  /// [rad] of the joint that is furthest from home.
  double from_home() const;

  /// What this machine has spent on the simulation of the arm and its bus, which a host of a real
  /// arm would not have to: ticks of platform::ticks().
  std::uint64_t ticks_spent() const { return ticks_spent_; }
  /// Of the emulator's clock, before the application's.
  base::Duration ahead() const { return ahead_; }

  Emulator& emulator() { return *emulator_; }
  ArmMotors& motors() { return motors_; }
  can::VirtualStation& station() { return *host_; }

 private:
  EmulatedLink(const ArmNumbers& numbers, ArmSimulation arm, Time time, base::Time begin)
      : time_(time), home_(numbers.home), motors_(std::move(arm), begin) {}
  void advance_to(base::Time now);
  void keep_holding();

  const Time time_;
  const std::vector<double>& home_;
  bool held_ = false;
  base::Duration ahead_{};
  std::uint64_t ticks_spent_ = 0;
  ArmMotors motors_;
  std::unique_ptr<Emulator> emulator_;
  can::VirtualStation* host_ = nullptr;
};

}  // namespace armature::wam
