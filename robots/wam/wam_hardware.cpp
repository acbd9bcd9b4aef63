// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/wam_hardware.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/base/seconds.hpp"
#include "armature/can/bus_link.hpp"
#include "armature/can/make_bus.hpp"
#include "robots/wam/arm_parts.hpp"
#include "robots/wam/driver/arm_connection.hpp"
#include "robots/wam/driver/safety_text.hpp"
#include "robots/wam/driver/wam_guard.hpp"
#include "robots/wam/tip_speed.hpp"

namespace armature::wam {

using component::Outcome;

namespace {

/// Cycles in a row without torques, from which on nobody controls the arm any more.
constexpr int kMostWithoutCommand = 3;
/// [m/s] of a motion: the board idles the arm at 1 m/s, and what follows overshoots a little.
constexpr double kFastestTip = 0.95;
constexpr std::string_view kReach = ", expected 0.1 ms to 100 ms";

bool within_its_reach(base::Duration period) {
  return period >= std::chrono::microseconds(100) && period <= std::chrono::milliseconds(100);
}

}  // namespace

// ---- Its configuration

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
  std::vector<std::string> warnings;
  auto parts = ArmParts::make(*numbers_, parameters_, description_, warnings);
  for (const std::string& warning : warnings) log_warning("{}", warning);
  if (!parts) return component::refused(parts.error());
  ArmParts made = std::move(parts).value();
  motion_.emplace(std::move(made.motion));
  path_.emplace(std::move(made.path));
  standing_.emplace(std::move(made.standing));
  driven_.emplace(std::move(made.driven));
  own_controller_.emplace(std::move(made.own_controller));
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
  check.error(std::string(why.append(kReach).view()),
              "use 2 ms, for which its controllers are made");
}

/// The emulated arm outlives a configuration, as a real one does.
Outcome WamHardware::make_link() {
  const bool emulated = bus_.get() == "emulator";
  if (emulated && emulated_ != nullptr) return component::accepted();
  emulated_ = nullptr;
  operator_.reset();
  if (!emulated) {
    link_ = std::make_unique<can::BusLink>(bus_, kBitRate);
    return component::accepted();
  }
  EmulatedLink::Config config;
  config.arm.urdf_file = description_.file();
  config.time = is_simulated() ? EmulatedLink::Time::kSimulated : EmulatedLink::Time::kReal;
  config.begin = time();
  auto made = EmulatedLink::make(*numbers_, config);
  if (!made) return component::refused(made.error());
  emulated_ = made.value().get();
  operator_.emplace(*emulated_);
  link_ = std::move(made).value();
  return component::accepted();
}

Outcome WamHardware::connect(bool said_at_home) {
  const bool helped = operator_ && emulated_operator_;
  if (helped) operator_->bring_to_idle();
  ArmConnectionConfig config;
  config.patience = base::from_seconds(idle_patience_);
  config.at_home = said_at_home || helped;
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

Outcome WamHardware::guard_arm() {
  if (is_simulated()) return component::accepted();
  const Outcome outcome =
      emulated_ != nullptr ? guard_.do_without("the emulated arm ends with this process")
                           : guard_.start(guard_orders(driver_->arm(), bus_,
                                                       base::from_seconds(parameters_.period())));
  if (!outcome || guard_.said().empty()) return outcome;
  guard_.complains() ? log_warning("{}", guard_.said()) : log_info("{}", guard_.said());
  return outcome;
}

Outcome WamHardware::on_start() {
  if (positions_lost_) return component::refused(fault_reason(WamFault::kEstop, 0));
  at_home_.withdraw();  // It counts for a configuration that follows; from now on the arm moves.
  held_by_hand_.withdraw();
  link_->begin_run(time());
  driver_->start(link_->now());
  driver_->send_idle();  // A puck may have missed that the board went to idle.
  path_->go_off();
  motion_->forget();
  watch_.begin(parameters_.period().duration());
  followed_ = base::Time::min();
  read_at_ = base::Time::min();
  idle_seen_ = commanded_ = false;
  if (operator_) operator_->rest();
  without_command_ = 0;
  cause_.forget();
  waits_for_.assign({});
  lost_answers_.assign(0);
  cycles_without_command_.assign(0);
  arming_ = arm_.bound() ? &arm_.source()->owner() : nullptr;
  return component::accepted();
}

void WamHardware::on_cleanup() {
  // What was sent last gets on its way.
  const base::Time end = link_->now() + std::chrono::milliseconds(2);
  while (link_->now() < end) link_->wait_for_news(end);
  guard_.end();
  driver_.reset();
  link_->bus().close();
}

// ---- The cycle

bool WamHardware::get_joint_sensors() {
  if (state() != component::State::kRunning) return false;
  on_sample();
  if (state() != component::State::kRunning || !motion_->known()) return false;
  const std::size_t joints = path_->joints();
  std::ranges::copy(motion_->positions(), data_.begin());
  std::ranges::copy(motion_->velocities(), data_.begin() + static_cast<std::ptrdiff_t>(joints));
  std::ranges::copy(path_->joint_torques(),
                    data_.begin() + static_cast<std::ptrdiff_t>(2 * joints));
  joints_data_.write(data_);
  return true;
}

void WamHardware::on_sample() {
  if (read_at_ != time() && is_guarded() && is_in_time()) read_all();
}

/// Out of service if it is sampled otherwise than everything is computed for.
bool WamHardware::is_in_time() {
  if (state() != component::State::kRunning) return true;
  const std::optional<component::Reason> wrong = watch_.sample(*this);
  if (wrong) fault(*wrong);
  return !wrong;
}

void WamHardware::read_all() {
  read_at_ = time();
  link_->begin_cycle(time());
  // The board hears torques in every cycle, also if who commands them is late.
  if (armed() && !commanded_) driver_->send_torques(link_->now());
  const base::Time asked_at = link_->now();
  driver_->begin_reading(asked_at);
  while (driver_->poll(link_->now()) == WamReading::kWaiting) {
    link_->wait_for_news(driver_->deadline());
  }
  motion_->take(*driver_, asked_at);
  path_->measure(motion_->positions(), motion_->velocities());
  count_lost_answers();
  if (!supervise()) return;
  drive_or_hold();
  if (move_home_.active()) follow_home();
}

void WamHardware::count_lost_answers() {
  if (driver_->reading() == WamReading::kComplete) return;
  int lost = 0;
  for (std::size_t i = 0; i < driver_->motors(); ++i) lost += driver_->motor(i).fresh ? 0 : 1;
  lost_answers_.assign(lost_answers_() + lost);
}

/// Armed, torques come later in this cycle.
void WamHardware::drive_or_hold() {
  if (armed()) {
    without_command_ = std::exchange(commanded_, false) ? 0 : without_command_ + 1;
    if (without_command_ > 0) cycles_without_command_.assign(cycles_without_command_() + 1);
    if (without_command_ >= kMostWithoutCommand) disarm("torques have stopped coming");
    if (arming_ != nullptr && arming_->state() == component::State::kException) {
      disarm("the component that armed it is out of service");
    }
    watch_driven();
  }
  if (armed()) return;
  if (path_->mode() == TorquePath::Mode::kHolding) return hold();
  standing_->move();
  send_torques();
}

/// Whatever its controller does, it comes to rest and is held.
void WamHardware::watch_driven() {
  if (!armed()) return;
  const auto why =
      driven_->step({.positions = motion_->positions(),
                     .velocities = motion_->velocities(),
                     .torques = path_->moving_torques(),
                     .weight = path_->weight(),
                     .tip = TipSpeed::of(motion_->positions(), motion_->velocities())});
  if (why) disarm(why->view(), TorquePath::Last::kEndsAtOnce);
}

/// Where it is, and watched: whatever does not fit the arm must not shake it.
void WamHardware::hold() {
  standing_->stand(motion_->velocities());
  if (const auto why =
          standing_->step(motion_->positions(), motion_->velocities(), path_->moving_torques())) {
    leave_service();
    return fault(*why);  // which has the pucks braked
  }
  path_->step_hold(link_->now());
  send_torques();
}

void WamHardware::on_torque(const Vector& torques) {
  if (!armed() || std::exchange(commanded_, true)) return;
  const auto result = path_->step_drive(torques, link_->now());
  clipped_.assign(path_->clipped());
  if (result == TorquePath::Result::kNotFinite) disarm("a torque is not a finite number");
  send_torques();
}

void WamHardware::on_position(const Vector& reference) {
  if (!motion_->known()) return;
  const base::Duration pause = kMostWithoutCommand * parameters_.period().duration();
  if (base::later(followed_, pause) < time()) {
    own_controller_->reset_to(reference, motion_->positions());
  }
  followed_ = time();
  own_controller_->step(reference, motion_->positions(), own_torques_);
  control_data_.write(own_torques_);
}

void WamHardware::send_torques() {
  const base::Time now = link_->now();
  const std::span<const double> torques = path_->motor_torques();
  for (std::size_t i = 0; i < torques.size(); ++i) driver_->set_torque(i, torques[i], now);
  driver_->send_torques(now);
  std::ranges::copy(path_->joint_torques(), sent_.begin());
  sent_torques_.write(sent_);
}

// ---- Arming

void WamHardware::on_arm() {
  if (armed()) return;
  if (!path_->begin_to_drive()) {
    log_error("not armed: the arm is not active, it waits for {}", waits_for_.get().view());
    return tell_armed(false);
  }
  held_by_hand_.withdraw();
  standing_->move();
  driven_->begin();
  followed_ = base::Time::min();
  without_command_ = 0;
  commanded_ = true;  // from the next cycle on
  tell_armed(true);
  log_info("armed");
}

void WamHardware::disarm(std::string_view why, TorquePath::Last driven) {
  const bool was_armed = armed();
  if (was_armed) path_->begin_to_hold(driven);
  tell_armed(false);
  if (was_armed) log_warning("disarmed, and holds the arm where it is: {}", why);
  if (move_home_.active()) move_home_.fail("disarmed");
}

void WamHardware::tell_armed(bool armed) {
  for (std::size_t i = 0; i < armed_.size(); ++i) armed_[i].write(armed);
}

// ---- Commands

/// In whichever thread; it knows nothing but the arm's shape.
double WamHardware::motion_limit_used(const Vector& positions, const Vector& velocities) {
  const auto joints = static_cast<std::size_t>(joints_.get());
  const bool fit = positions.size() == joints && velocities.size() == joints;
  if (!fit) return std::numeric_limits<double>::infinity();
  return TipSpeed::of(positions, velocities) / kFastestTip;
}

Outcome WamHardware::move_home() {
  if (!armed()) return component::refused("the arm is not armed");
  return way_home_.begin({numbers_->home, motion_->positions(), time()});
}

void WamHardware::follow_home() {
  move_home_.report(way_home_.progress());
  if (!way_home_.follow({numbers_->home, motion_->positions(), time()})) return;
  if (way_home_.done()) {
    move_home_.complete();
  } else {
    move_home_.fail(way_home_.reason());
  }
}

Outcome WamHardware::press(void (EmulatedOperator::*key)(), component::Command<>& command) {
  if (!operator_) {
    if (bus_.get() == "emulator")
      return component::refused("the arm is emulated once it is configured");
    component::Reason why("the arm on ");
    return component::refused(
        why.append(bus_.get()).append(" has an operator and a pendant of its own"));
  }
  ((*operator_).*key)();
  command.complete();
  return component::accepted();
}

}  // namespace armature::wam
