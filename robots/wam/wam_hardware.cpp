// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/wam_hardware.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/base/seconds.hpp"
#include "armature/can/bus_link.hpp"
#include "armature/can/make_bus.hpp"
#include "armature/component/face.hpp"
#include "armature/controllers/base/reason_text.hpp"
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
  if (input != &face(torque_reference_) && input != &face(added_torques_)) return {};
  std::vector<controllers::DrivenJoint> joints = arm_check_.driven();
  if (input == &face(torque_reference_)) return joints;
  for (controllers::DrivenJoint& joint : joints) {  // somebody else holds the weight
    joint.holds_weight = controllers::HoldsWeight::kHardware;
  }
  return joints;
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
  float_gate_.emplace(std::move(made.float_gate));
  puck_ports_.set_up(numbers_->joints());
  all_torques_.assign(numbers_->joints(), 0.0);
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
  check_reference(check);
  const base::Duration period = parameters_.period().duration();
  if (period == base::Duration::zero() || within_its_reach(period)) return;
  component::Reason why("it is sampled every ");
  controllers::append_duration(why, period);
  check.error(std::string(why.append(kReach).view()),
              "use 2 ms, for which its controllers are made");
}

void WamHardware::check_reference(component::Check& check) const {
  for (const component::OutputPortBase* const writer : check.writers_of(position_reference_)) {
    const std::size_t size = writer->declared_size().value();
    if (!writer->declared_size().declared() || is_reference(size)) continue;
    check.error(std::string(position_reference_.name()) + " gets " + std::to_string(size) +
                    " numbers from '" + writer->owner().name() + "." + std::string(writer->name()) +
                    "', expected " + std::to_string(joints_.get()) + " positions, or " +
                    std::to_string(2 * joints_.get()) + " with velocities",
                "connect an output of that size");
  }
}

bool WamHardware::is_reference(std::size_t size) const {
  const auto joints = static_cast<std::size_t>(joints_.get());
  return size == joints || size == 2 * joints;
}

base::Duration WamHardware::operators_patience() const {
  return base::from_seconds(idle_patience_);
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
  config.ask_for_idle = [this](std::optional<BoardMode> mode, base::Duration left) {
    log_warning(
        "the safety board is in {}: pull the E-stop button out and press Shift+Idle, which gives "
        "the pucks their power; waits {} s for it",
        safety_state(mode), std::round(base::to_seconds(left)));
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
  if (position_reference_.connected() && !is_reference(position_reference_.read().value.size())) {
    return component::refused(
        "posRefPort gets another number of values than that of the joints, "
        "or twice that with velocities");
  }
  at_home_.withdraw();  // It counts for a configuration that follows; from now on the arm moves.
  held_by_hand_.withdraw();
  link_->begin_run(time());
  driver_->start(link_->now());
  driver_->send_idle();  // A puck may have missed that the board went to idle.
  puck_ports_.begin(*driver_, link_->now());
  path_->go_off();
  weightless_.assign(false);
  motion_->forget();
  watch_.begin(parameters_.period().duration());
  followed_ = base::Time::min();
  read_at_ = base::Time::min();
  idle_seen_ = commanded_ = false;
  if (operator_) operator_->rest();
  without_command_ = 0;
  why_without_ = {};
  refused_.assign(0);
  cause_.forget();
  waits_for_.assign({});
  lost_answers_.assign(0);
  cycles_without_command_.assign(0);
  arming_ = arm_.bound() ? &face(arm_).source()->owner() : nullptr;
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
  asked_at_ = link_->now();
  driver_->begin_reading(asked_at_);
  while (driver_->poll(link_->now()) == WamReading::kWaiting) {
    link_->wait_for_news(driver_->deadline());
  }
  motion_->take(*driver_, asked_at_);
  puck_ports_.tell(*driver_);
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
    if (without_command_ >= kMostWithoutCommand) {
      disarm(why_without_.empty() ? "torques have stopped coming" : why_without_.view());
    }
    if (arming_ != nullptr && arming_->state() == component::State::kException) {
      disarm("the component that armed it is out of service");
    }
    watch_driven();
  }
  if (armed()) return;
  if (path_->mode() == TorquePath::Mode::kHolding) return hold();
  if (path_->mode() == TorquePath::Mode::kWeightless) return float_on();
  standing_->move();
  send_torques();
  watch_pucks();
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
  watch_pucks();
  begin_to_float();
}

void WamHardware::on_torque(const Vector& torques) {
  if (!armed() || std::exchange(commanded_, true)) return;
  std::ranges::copy(torques, all_torques_.begin());
  if (const auto added = added_torques_.read()) {
    for (std::size_t i = 0; i < all_torques_.size(); ++i) all_torques_[i] += added.value[i];
  }
  const auto result = path_->step_drive(all_torques_, link_->now());
  if (result == TorquePath::Result::kRefused) return refuse_torques(all_torques_);
  clipped_.assign(path_->clipped());
  why_without_ = {};
  if (result == TorquePath::Result::kNotFinite) disarm("a torque is not a finite number");
  send_torques();
  watch_pucks();
}

/// As if none had come.
void WamHardware::refuse_torques(const Vector& torques) {
  commanded_ = false;
  refused_.assign(refused_() + 1);
  if (!why_without_.empty()) return;
  const std::size_t joint = path_->first_over_limit(torques);
  why_without_ = component::Reason("no torque is sent: that of joint ");
  controllers::append_number(why_without_, static_cast<double>(joint + 1)).append(" is ");
  controllers::append_number(why_without_, torques[joint]).append(" Nm, above its limit");
  log_warning("{}", why_without_.view());
}

void WamHardware::on_position(const Vector& reference) {
  if (!motion_->known() || !is_reference(reference.size())) return;
  const base::Duration pause = kMostWithoutCommand * parameters_.period().duration();
  if (base::later(followed_, pause) < time()) {
    own_controller_->reset_to(reference, motion_->positions());
  }
  followed_ = time();
  const std::size_t joints = path_->joints();
  const std::span<const double> all(reference);
  if (all.size() == joints) {
    own_controller_->step(all, motion_->positions(), own_torques_);
  } else {
    own_controller_->step(all.first(joints), all.last(joints), motion_->positions(), own_torques_);
  }
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

/// Behind the torques, where the bus is free until the next cycle.
void WamHardware::watch_pucks() {
  puck_ports_.ask(*driver_, link_->now(), asked_at_ + parameters_.period().duration());
}

}  // namespace armature::wam
