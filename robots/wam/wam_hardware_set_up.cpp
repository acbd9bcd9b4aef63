// SPDX-License-Identifier: Apache-2.0
// WamHardware: from its properties to an arm that is ready for its cycle.
#include <chrono>
#include <string>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/base/seconds.hpp"
#include "armature/can/bus_link.hpp"
#include "armature/platform/clock.hpp"
#include "robots/wam/arm_connection.hpp"
#include "robots/wam/safety_text.hpp"
#include "robots/wam/wam_hardware.hpp"

namespace armature::wam {

using component::Outcome;

namespace {

constexpr double kAtHome = 1e-6;  // [rad]

}  // namespace

Outcome WamHardware::on_configure() {
  if (joints_ != 4 && joints_ != 7) {
    return component::refused("joints is " + std::to_string(joints_) +
                              ", expected 4, or 7 with the wrist");
  }
  numbers_ = joints_ == 4 ? &wam4() : &wam7();
  if (Outcome outcome = set_up_path(); !outcome) return outcome;
  if (Outcome outcome = make_link(); !outcome) return outcome;
  base::Diagnostics diagnostics;
  if (!link_->open(WamDriver::bus_options(), diagnostics)) {
    return component::refused(base::as_reason(diagnostics));
  }
  if (Outcome outcome = connect(); !outcome) {
    link_->bus().close();
    return outcome;
  }
  positions_lost_ = false;
  return component::accepted();
}

Outcome WamHardware::set_up_path() {
  const auto config = parameters_.torque_path(*numbers_);
  if (!config) return component::refused(config.error());
  std::vector<std::string> warnings;
  auto links = description_.load(numbers_->joints(), warnings);
  if (!links) return component::refused(links.error());
  for (const std::string& warning : warnings) log_warning("{}", warning);
  auto transmission = control::Transmission::make(numbers_->transmission);
  if (!transmission) return component::refused(transmission.error());
  motion_.emplace(transmission.value());
  auto own =
      JointController::make({.gains = config.value().hold, .period_s = parameters_.period()});
  if (!own) return component::refused(own.error());
  own_controller_.emplace(std::move(own).value());
  auto path = TorquePath::make(config.value(), transmission.value(), std::move(links).value());
  if (!path) return component::refused(path.error());
  path_.emplace(std::move(path).value());
  own_torques_.assign(numbers_->joints(), 0.0);
  sent_.assign(numbers_->joints(), 0.0);
  data_.assign(3 * numbers_->joints(), 0.0);
  clipped_.assign(0);
  return component::accepted();
}

/// The emulated arm outlives a configuration, as a real one does.
Outcome WamHardware::make_link() {
  const bool emulated = bus_.get() == "emulator";
  if (emulated && emulated_ != nullptr) return component::accepted();
  emulated_ = nullptr;
  if (!emulated) {
    link_ = std::make_unique<can::BusLink>(bus_, kBitRate);
    return component::accepted();
  }
  EmulatedLink::Config config;
  config.arm.urdf_file = description_.file();
  config.time = context().simulated ? EmulatedLink::Time::kSimulated : EmulatedLink::Time::kReal;
  config.begin = time();
  auto made = EmulatedLink::make(*numbers_, config);
  if (!made) return component::refused(made.error());
  emulated_ = made.value().get();
  link_ = std::move(made).value();
  return component::accepted();
}

Outcome WamHardware::connect() {
  if (emulated_ != nullptr && emulated_operator_) help_to_idle();
  ArmConnectionConfig config;
  config.patience = base::from_seconds(idle_patience_);
  config.at_home = at_home_ || (emulated_ != nullptr && emulated_operator_);
  config.ask_for_idle = [this](std::optional<BoardMode> mode) {
    log_warning(
        "the safety board is in {}: pull the E-stop button out and press Shift+Idle, which gives "
        "the pucks their power; waits {} s for it",
        safety_state(mode), idle_patience_.get());
  };
  std::vector<std::string> warnings;
  const auto record = connect_arm(*link_, *numbers_, config, warnings);
  if (!record) return component::refused(record.error());
  for (const std::string& warning : warnings) log_warning("{}", warning);
  auto driver = WamDriver::make(link_->bus(), record.value(), {});
  if (!driver) return component::refused(driver.error());
  driver_.emplace(std::move(driver).value());
  return component::accepted();
}

/// As an operator would: carries the arm home if it lies without power, lets it have some, and
/// holds it until it holds itself.
void WamHardware::help_to_idle() {
  SafetyBoard& board = emulated_->emulator().board();
  emulated_->hold_at_home();
  while (emulated_->from_home() > kAtHome) {
    emulated_->wait_for_news(emulated_->now() + std::chrono::milliseconds(10));
  }
  board.reset();
  board.shift_idle();
}

}  // namespace armature::wam
