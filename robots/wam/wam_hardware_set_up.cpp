// SPDX-License-Identifier: Apache-2.0
// WamHardware: from its properties to an arm that is ready for its cycle.
#include <chrono>
#include <string>
#include <string_view>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/base/seconds.hpp"
#include "armature/can/bus_link.hpp"
#include "armature/can/make_bus.hpp"
#include "armature/platform/clock.hpp"
#include "robots/wam/driver/arm_connection.hpp"
#include "robots/wam/driver/safety_text.hpp"
#include "robots/wam/wam_hardware.hpp"

namespace armature::wam {

using component::Outcome;

namespace {

constexpr double kEmulatedAtHome = 1e-6;  // [rad]
constexpr std::string_view kReach = ", expected 0.1 ms to 100 ms";

bool within_its_reach(base::Duration period) {
  return period >= std::chrono::microseconds(100) && period <= std::chrono::milliseconds(100);
}

}  // namespace

Outcome WamHardware::on_configure() {
  const bool said_at_home = at_home_.take();  // of this configuration, whatever becomes of it
  if (joints_ != 4 && joints_ != 7) {
    return component::refused("joints is " + std::to_string(joints_) +
                              ", expected 4, or 7 with the wrist");
  }
  numbers_ = joints_ == 4 ? &wam4() : &wam7();
  if (Outcome outcome = set_up_path(); !outcome) return outcome;
  if (Outcome outcome = make_link(); !outcome) return outcome;
  base::Diagnostics diagnostics;
  if (!link_->open(WamDriver::bus_options(), diagnostics)) {
    return component::refused(base::as_reason(diagnostics) +
                              "; bus is emulator, virtual:PATH or a CAN interface such as can0");
  }
  Outcome outcome = connect(said_at_home);
  if (outcome) outcome = guard_arm();
  if (!outcome) {
    link_->bus().close();
    return outcome;
  }
  positions_lost_ = false;
  return component::accepted();
}

std::vector<controllers::DrivenJoint> WamHardware::joints_behind(
    const component::InputPortBase* input, const component::Check& /*check*/) {
  return input == &torque_reference_ ? arm_check_.driven()
                                     : std::vector<controllers::DrivenJoint>{};
}

Outcome WamHardware::set_up_path() {
  if (Outcome outcome = check_period(); !outcome) return outcome;
  const auto config = parameters_.torque_path(*numbers_);
  if (!config) return component::refused(config.error());
  parameters_.show_gains(config.value().hold);
  std::vector<std::string> warnings;
  auto links = description_.load(numbers_->joints(), warnings);
  if (!links) return component::refused(links.error());
  for (const std::string& warning : warnings) log_warning("{}", warning);
  auto transmission = control::Transmission::make(numbers_->transmission);
  if (!transmission) return component::refused(transmission.error());
  motion_.emplace(transmission.value());
  auto own = JointController::make(
      {.gains = config.value().hold, .period_s = parameters_.period().seconds()});
  if (!own) return component::refused(own.error());
  own_controller_.emplace(std::move(own).value());
  auto path = TorquePath::make(config.value(), transmission.value(), std::move(links).value());
  if (!path) return component::refused(path.error());
  path_.emplace(std::move(path).value());
  const auto bounds = parameters_.standing_watch(*numbers_);
  if (!bounds) return component::refused(bounds.error());
  auto standing = StandingWatch::make(bounds.value());
  if (!standing) return component::refused(standing.error());
  standing_.emplace(std::move(standing).value());
  const auto driven_bounds = parameters_.driven_watch(*numbers_);
  if (!driven_bounds) return component::refused(driven_bounds.error());
  auto driven = DrivenWatch::make(driven_bounds.value());
  if (!driven) return component::refused(driven.error());
  driven_.emplace(std::move(driven).value());
  own_torques_.assign(numbers_->joints(), 0.0);
  sent_.assign(numbers_->joints(), 0.0);
  data_.assign(3 * numbers_->joints(), 0.0);
  clipped_.assign(0);
  return component::accepted();
}

Outcome WamHardware::check_period() const {
  if (Outcome outcome = parameters_.period().known(); !outcome) return outcome;
  if (within_its_reach(parameters_.period().duration())) return component::accepted();
  component::Reason why("the period between two samples is ");
  controllers::append_duration(why, parameters_.period().duration());
  return component::refused(why.append(kReach));
}

void WamHardware::on_check(component::Check& check) const {
  if (bus_.get() != "emulator" && !can::is_virtual(bus_.get())) check.drives_hardware(bus_.get());
  const base::Duration period = parameters_.period().duration();
  if (period == base::Duration::zero() || within_its_reach(period)) return;
  component::Reason why("it is sampled every ");
  controllers::append_duration(why, period);
  check.error(std::string(why.append(kReach).view()), "2 ms is what its controllers are made for");
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

Outcome WamHardware::connect(bool said_at_home) {
  if (emulated_ != nullptr && emulated_operator_) help_to_idle();
  ArmConnectionConfig config;
  config.patience = base::from_seconds(idle_patience_);
  config.at_home = said_at_home || (emulated_ != nullptr && emulated_operator_);
  config.word = name() + "." + std::string(at_home_.name());
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
  while (emulated_->from_home() > kEmulatedAtHome) {
    emulated_->wait_for_news(emulated_->now() + std::chrono::milliseconds(10));
  }
  board.reset();
  board.shift_idle();
}

}  // namespace armature::wam
