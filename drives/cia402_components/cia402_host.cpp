// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402_components/cia402_host.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/base/seconds.hpp"
#include "armature/controllers/base/max_age.hpp"
#include "drives/canopen/nmt.hpp"
#include "drives/cia402_components/bus_plan.hpp"
#include "drives/cia402_components/prepare_bus.hpp"

namespace armature::cia402 {

using component::Outcome;

namespace {

constexpr int kLastNode = 127;
/// What torques of drives are told in: thousandths of the rated one.
constexpr int kRated = 1000;
/// Drives take as many of the host's for a loss.
constexpr int kHeartbeatsToMiss = 3;
/// Where their answers are among a drive's slow numbers.
constexpr std::size_t kSlowCurrent = 0;
constexpr std::size_t kSlowTemperature = 1;

/// Between two questions, so that each drive answers all of its own within `period`.
base::Duration pause_between(const DriveGroup& drives, base::Duration period) {
  std::size_t questions = 0;
  for (std::size_t i = 0; i < drives.size(); ++i) questions += drives.config(i).slow.size();
  return questions > 0 ? period / static_cast<int>(questions) : period;
}

}  // namespace

// --- what the deployment says --------------------------------------------------------------------

void Cia402Host::on_check(component::Check& check) const {
  check_nodes(nodes_, host_heartbeat_ > 0.0 ? host_node_.get() : 0, check);
  plan_by_own_words();
  refine_plans(*this, plans_, check);
  check_bus_time(plans_, bit_rate(), cycle(), check);
  check_answer_time(plans_, cycle(), check);
}

DrivePlan Cia402Host::plan_of(int node) const {
  DrivePlan plan;
  plan.wish = {.node = static_cast<canopen::NodeId>(node),
               .name = name() + "." + std::to_string(node),
               .mode = mode_of(mode_),
               .unit = unit_ == DriveUnit::kFeed ? PositionUnit::kFeed : PositionUnit::kIncrements,
               .cycle = cycle(),
               .heartbeat = base::from_seconds(heartbeat_)};
  if (host_heartbeat_ > 0.0) {
    const base::Duration period = base::from_seconds(host_heartbeat_);
    plan.wish.host = HostHeartbeat{.node = static_cast<canopen::NodeId>(host_node_.get()),
                                   .period = period,
                                   .timeout = kHeartbeatsToMiss * period};
  }
  plan.mode = mode_;
  plan.eds_file = eds_;
  plan.expect(vendor_, product_);
  return plan;
}

// --- the start -----------------------------------------------------------------------------------

Outcome Cia402Host::on_configure() {
  if (Outcome outcome = period_.known(); !outcome) return outcome;
  if (Outcome outcome = know_plans(); !outcome) return outcome;
  find_places();
  auto link = make_link();
  if (!link) return component::refused(link.error());
  link_ = std::move(link).value();
  base::Diagnostics diagnostics;
  if (!link_->open({.receive_capacity = 1024}, diagnostics)) {
    return component::refused(base::as_reason(diagnostics));
  }
  if (Outcome outcome = prepare(); !outcome) return outcome;
  return begin_to_guard();
}

/// The check has made them, and sees what each drive says of itself; a host by itself has only its
/// own words.
Outcome Cia402Host::know_plans() {
  if (plans_.empty()) plan_by_own_words();
  const auto is_of = [](const DrivePlan& plan, int node) { return plan.wish.node == node; };
  if (std::ranges::equal(plans_, nodes_.get(), is_of)) return component::accepted();
  return component::refused("nodes are not those of the check: start the application anew");
}

void Cia402Host::plan_by_own_words() const {
  plans_.clear();
  for (const int node : nodes_.get()) plans_.push_back(plan_of(node));
}

void Cia402Host::find_places() {
  place_of_.assign(kLastNode + 1, std::nullopt);
  for (std::size_t i = 0; i < nodes_.get().size(); ++i) {
    place_of_[static_cast<std::size_t>(nodes_.get()[i])] = i;
  }
  accounts_.assign(nodes_.get().size(), {});
  find_homing();
}

Outcome Cia402Host::prepare() {
  auto group = prepare_bus(*link_, plans_, asks_slowly());
  if (!group) return component::refused(group.error());
  group_.emplace(std::move(group).value());
  background_.emplace(*group_, pause_between(*group_, base::from_seconds(slow_period_)));
  return component::accepted();
}

/// With a SYNC whose answers are there when the first cycle begins.
Outcome Cia402Host::on_start() {
  cycle_at_ = base::Time::min();
  lost_answers_.assign(0);
  refused_frames_.assign(0);
  take_frames();
  for (std::size_t i = 0; i < group_->size(); ++i) {
    group_->set_goal(i, PowerGoal::kOff);
    accounts_[i].seen = group_->state(i).time;
    accounts_[i].target_at = {};
    accounts_[i].dropped = false;
  }
  begin_heartbeat();
  static_cast<void>(group_->step(link_->bus(), link_->now()));
  pass_time(*link_, cycle());
  link_->begin_run(time());
  return component::accepted();
}

/// Drives do not wait for the heartbeat of a host that has ended in good order.
void Cia402Host::on_stop() {
  make_safe();
  if (host_heartbeat_ <= 0.0) return;
  background_->end_heartbeat(link_->bus(), link_->now());
  group_->set_heartbeat(static_cast<canopen::NodeId>(host_node_.get()), {}, link_->now());
}

void Cia402Host::begin_heartbeat() {
  if (host_heartbeat_ <= 0.0) return;
  announce_heartbeat(*link_, plans_);
  group_->set_heartbeat(static_cast<canopen::NodeId>(host_node_.get()),
                        base::from_seconds(host_heartbeat_), link_->now());
}

void Cia402Host::on_cleanup() {
  end_guard();
  background_.reset();
  group_.reset();
  link_.reset();
}

// --- the cycle ---------------------------------------------------------------------------------

DriveSample Cia402Host::read_drive(int node) {
  const auto place = place_of(node);
  if (!place || state() != component::State::kRunning) return {.no_bus = true};
  if (cycle_at_ != time()) {
    if (!is_guarded()) return {.no_bus = true};
    begin_cycle();
  }
  const DriveState& drive = group_->state(*place);
  Account& account = accounts_[*place];
  const can::BusState bus = link_->bus().state();
  DriveSample sample;
  sample.no_bus = bus != can::BusState::kActive && bus != can::BusState::kPassive;
  sample.fresh = drive.time > account.seen;
  sample.position = drive.position;
  sample.velocity = drive.velocity;
  sample.effort = drive.effort;
  sample.power = drive.power ? static_cast<int>(*drive.power) : -1;
  sample.silent_cycles = static_cast<int>(drive.silent_cycles);
  sample.error_code = drive.emergency ? drive.emergency->code : drive.error_code;
  sample.lost = drive.presence == canopen::Presence::kLost;
  sample.obeys = account.torque != TorqueWatch::Finding::kDisobeys;
  sample.frozen = account.torque == TorqueWatch::Finding::kFrozen;
  sample.status = drive.status;
  sample.unprepared = has_rebooted(*place);
  if (account.homing) sample.homing = static_cast<int>(account.homing->stage());
  read_slow(*place, sample);
  account.seen = drive.time;
  return sample;
}

void Cia402Host::read_slow(std::size_t place, DriveSample& sample) const {
  const DriveConfig& drive = group_->config(place);
  for (std::size_t i = 0; i < drive.slow.size(); ++i) {
    const auto number = background_->number(place, i);
    if (!number) continue;
    if (i == kSlowCurrent) {
      sample.has_current = true;
      sample.current = drive.scaling.current(*number);
    } else if (i == kSlowTemperature && plans_[place].temperature) {
      sample.has_temperature = true;
      sample.temperature = plans_[place].temperature_offset +
                           plans_[place].temperature_scale * static_cast<double>(*number);
    }
  }
}

void Cia402Host::begin_cycle() {
  cycle_at_ = time();
  link_->begin_cycle(time());
  take_frames();
  drop_old_targets();
  step_homing();
  const std::size_t refused = group_->step(link_->bus(), link_->now());
  if (refused > 0) refused_frames_.assign(refused_frames_() + static_cast<int>(refused));
  watch_torques();
  background_->step(link_->bus(), link_->now());
  follow_preparation();
  int silent = 0;
  for (std::size_t i = 0; i < group_->size(); ++i) silent += group_->state(i).silent_cycles > 1;
  if (silent > 0) lost_answers_.assign(lost_answers_() + silent);
}

/// Nobody else finds a drive without current, or values that are frozen: controllers would ask for
/// ever more torque.
void Cia402Host::watch_torques() {
  for (std::size_t i = 0; i < group_->size(); ++i) {
    if (plans_[i].mode != CyclicMode::kTorque) continue;
    Account& account = accounts_[i];
    if (account.homing && account.homing->stage() != HomingStage::kIdle) {
      account.watch = {};
      account.torque = TorqueWatch::Finding::kGood;
      continue;
    }
    const double rated = std::abs(group_->config(i).scaling.torque(kRated));
    account.torque = account.watch.step(group_->state(i), account.target, rated);
  }
}

/// Drives whose components have ended hear how they stop, that their host is there, and what the
/// operator says.
void Cia402Host::keep_cycle() {
  const bool was_read = cycle_at_ != base::Time::min() && time() < cycle_at_ + 3 * cycle() / 2;
  if (!was_read && is_guarded()) begin_cycle();
}

void Cia402Host::take_frames() {
  can::Arrival arrival;
  while (link_->bus().receive(arrival) == can::ReceiveStatus::kReceived) {
    group_->take(arrival);
    background_->take(arrival.frame, arrival.time);
  }
}

/// Who set them is gone. A position is held where the drive is when that is found.
void Cia402Host::drop_old_targets() {
  for (std::size_t i = 0; i < group_->size(); ++i) {
    Account& account = accounts_[i];
    const bool old = time() - account.target_at > controllers::kMaxAge;
    if (!old || std::exchange(account.dropped, true)) continue;
    account.target = no_target(i);
    group_->set_target(i, account.target);
  }
}

double Cia402Host::no_target(std::size_t drive) const {
  return plans_[drive].mode == CyclicMode::kPosition ? group_->state(drive).position : 0.0;
}

// --- what drives are told ------------------------------------------------------------------------

/// Only of the kind that the drive is in: 0 of another kind could be a place to go to.
bool Cia402Host::set_target(int node, CyclicMode mode, double target) {
  const auto place = place_of(node);
  if (!place || mode != plans_[*place].mode || !std::isfinite(target)) return false;
  group_->set_target(*place, target);
  accounts_[*place].target_at = time();
  accounts_[*place].target = target;
  accounts_[*place].dropped = false;
  return true;
}

bool Cia402Host::energize_drive(int node, bool enable, control::DrivePermit permit) {
  const auto place = place_of(node);
  if (!permit || !place || state() != component::State::kRunning) return false;
  if (is_unprepared(*place)) return false;
  const auto& homing = accounts_[*place].homing;
  if (homing && homing->stage() != HomingStage::kIdle) return false;
  group_->set_goal(*place, enable ? PowerGoal::kEnabled : PowerGoal::kSwitchedOn);
  return true;
}

bool Cia402Host::make_drive_safe(int node, bool quick_stop) {
  const auto place = place_of(node);
  if (!place) return false;
  if (accounts_[*place].homing) accounts_[*place].homing->leave();
  group_->set_goal(*place, quick_stop ? PowerGoal::kQuickStop : PowerGoal::kOff);
  return true;
}

bool Cia402Host::reset_drive(int node) {
  const auto place = place_of(node);
  if (!place) return false;
  if (!is_unprepared(*place)) {
    group_->ask_reset(*place);
    return true;
  }
  if (accounts_[*place].is_nmt_stopped) {
    const auto who = static_cast<canopen::NodeId>(node);
    link_->bus().send(canopen::nmt_frame(canopen::NmtCommand::kEnterPreOperational, who));
  }
  accounts_[*place].is_preparing = true;
  accounts_[*place].preparing = group_->state(*place).reboots;
  background_->prepare_again(*place);
  return true;
}

bool Cia402Host::has_rebooted(std::size_t place) const {
  return accounts_[place].reboots != group_->state(place).reboots;
}

/// Once more rebooted meanwhile, it still has to be prepared.
void Cia402Host::follow_preparation() {
  for (std::size_t i = 0; i < accounts_.size(); ++i) {
    Account& account = accounts_[i];
    const auto preparation = background_->preparation(i);
    if (!account.is_preparing || preparation == BackgroundSdo::Preparation::kUnderWay) continue;
    account.is_preparing = false;
    const int node = nodes_.get()[i];
    if (preparation == BackgroundSdo::Preparation::kDone) {
      account.reboots = account.preparing;
      account.is_started_again = account.is_nmt_stopped;
      log_info("the drive at node {} is who it was, and prepared again", node);
      continue;
    }
    const canopen::Address address = background_->refused_at(i);
    log_error(
        "the drive at node {} is not prepared: its object {} (index), {} (subindex) is not what it "
        "was at the start, or it does not answer; exchange it back, or configure its host again",
        node, int{address.index}, int{address.subindex});
  }
}

void Cia402Host::make_safe() {
  for (std::size_t i = 0; i < group_->size(); ++i) {
    if (accounts_[i].homing) accounts_[i].homing->leave();
    group_->set_target(i, no_target(i));
    group_->set_goal(i, PowerGoal::kQuickStop);
  }
  step_homing();
  static_cast<void>(group_->step(link_->bus(), link_->now()));
  rest();
}

std::optional<std::size_t> Cia402Host::place_of(int node) const {
  const bool known = node >= 1 && node <= kLastNode && group_;
  return known ? place_of_[static_cast<std::size_t>(node)] : std::nullopt;
}

}  // namespace armature::cia402
