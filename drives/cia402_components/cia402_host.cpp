// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402_components/cia402_host.hpp"

#include <chrono>
#include <cmath>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/base/seconds.hpp"
#include "armature/controllers/base/max_age.hpp"
#include "drives/canopen/nmt.hpp"
#include "drives/canopen/sdo_channel.hpp"
#include "drives/cia402/prepare_drive.hpp"

namespace armature::cia402 {

using component::Outcome;
using controllers::JointCommand;

namespace {

using namespace std::chrono_literals;

/// In which a drive takes a command of NMT.
constexpr base::Duration kNmtTime = 5ms;
constexpr int kLastNode = 127;
/// Of the rated torque, in thousandths, by which a drive may miss its target for as many cycles:
/// two until it acts, and what currents take to grow.
constexpr int kMostTorqueError = 50;
constexpr int kMostDisobeyed = 10;

Mode mode_of(CyclicMode mode) {
  if (mode == CyclicMode::kTorque) return Mode::kCyclicTorque;
  return mode == CyclicMode::kVelocity ? Mode::kCyclicVelocity : Mode::kCyclicPosition;
}

void pass_time(can::Link& link, base::Duration time) {
  const base::Time until = link.now() + time;
  while (link.now() < until) link.wait_for_news(until);
}

}  // namespace

JointCommand Cia402Host::command() const {
  if (mode_ == CyclicMode::kTorque) return JointCommand::kTorque;
  return mode_ == CyclicMode::kVelocity ? JointCommand::kVelocity : JointCommand::kPosition;
}

Outcome Cia402Host::on_configure() {
  if (Outcome outcome = period_.known(); !outcome) return outcome;
  if (Outcome outcome = find_places(); !outcome) return outcome;
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

Outcome Cia402Host::find_places() {
  place_of_.assign(kLastNode + 1, std::nullopt);
  if (nodes_.get().empty()) return component::refused("nodes is empty: name the drives' numbers");
  for (std::size_t i = 0; i < nodes_.get().size(); ++i) {
    const int node = nodes_.get()[i];
    if (node < 1 || node > kLastNode) {
      return component::refused("nodes has " + std::to_string(node) + ", expected 1 to 127");
    }
    if (place_of_[static_cast<std::size_t>(node)]) {
      return component::refused("nodes has " + std::to_string(node) + " twice");
    }
    place_of_[static_cast<std::size_t>(node)] = i;
  }
  accounts_.assign(nodes_.get().size(), {});
  return component::accepted();
}

/// All that is wrong with all drives is told at once.
Outcome Cia402Host::prepare() {
  using canopen::NmtCommand;
  link_->bus().send(canopen::nmt_frame(NmtCommand::kEnterPreOperational, canopen::kEveryNode));
  pass_time(*link_, kNmtTime);
  base::Diagnostics diagnostics;
  std::vector<DriveConfig> configs;
  for (const int node : nodes_.get()) {
    DriveWish wish{
        .node = static_cast<canopen::NodeId>(node),
        .name = name() + "." + std::to_string(node),
        .mode = mode_of(mode_),
        .unit = unit_ == DriveUnit::kFeed ? PositionUnit::kFeed : PositionUnit::kIncrements,
        .cycle = cycle(),
        .heartbeat = base::from_seconds(heartbeat_)};
    wish.identity = {.vendor = static_cast<std::uint32_t>(vendor_.get()),
                     .product = static_cast<std::uint32_t>(product_.get())};
    canopen::SdoChannel channel(*link_, wish.node);
    if (auto config = prepare_drive(channel, wish, diagnostics)) configs.push_back(*config);
  }
  if (!diagnostics.ok()) return component::refused(base::as_reason(diagnostics));
  auto group = DriveGroup::make(std::move(configs));
  if (!group) return component::refused(group.error());
  group_.emplace(std::move(group).value());
  link_->bus().send(canopen::nmt_frame(NmtCommand::kStart, canopen::kEveryNode));
  pass_time(*link_, kNmtTime);
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
    accounts_[i] = {.seen = group_->state(i).time};
  }
  static_cast<void>(group_->step(link_->bus(), link_->now()));
  pass_time(*link_, cycle());
  link_->begin_run(time());
  return component::accepted();
}

void Cia402Host::on_cleanup() {
  end_guard();
  group_.reset();
  link_.reset();
}

// --- the cycle ---------------------------------------------------------------------------------

DriveSample Cia402Host::read_drive(int node) {
  const auto place = place_of(node);
  if (!place || state() != component::State::kRunning) return {.no_bus = true};
  if (!in_cycle()) return {.no_bus = true};
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
  sample.reboots = static_cast<int>(drive.reboots);
  sample.error_code = drive.emergency ? drive.emergency->code : drive.error_code;
  sample.lost = drive.presence == canopen::Presence::kLost;
  sample.warns = drive.warns();
  sample.limited = drive.limited();
  sample.obeys = account.disobeyed <= kMostDisobeyed;
  account.seen = drive.time;
  return sample;
}

/// Once at each time. Drives whose components are out of service are told to stop all the same,
/// and hear the operator's reset.
bool Cia402Host::in_cycle() {
  if (cycle_at_ == time()) return true;
  if (!is_guarded()) return false;
  begin_cycle();
  return true;
}

void Cia402Host::begin_cycle() {
  cycle_at_ = time();
  link_->begin_cycle(time());
  take_frames();
  drop_old_targets();
  const std::size_t refused = group_->step(link_->bus(), link_->now());
  if (refused > 0) refused_frames_.assign(refused_frames_() + static_cast<int>(refused));
  watch_torques();
  int silent = 0;
  for (std::size_t i = 0; i < group_->size(); ++i) silent += group_->state(i).silent_cycles > 1;
  if (silent > 0) lost_answers_.assign(lost_answers_() + silent);
}

/// Nobody else finds a drive without current, or values that are frozen: controllers would ask for
/// ever more torque.
void Cia402Host::watch_torques() {
  if (mode_ != CyclicMode::kTorque) return;
  for (std::size_t i = 0; i < group_->size(); ++i) {
    const DriveState& drive = group_->state(i);
    Account& account = accounts_[i];
    const double most = std::abs(group_->config(i).scaling.torque(kMostTorqueError));
    const bool obeys = !drive.enabled() || std::abs(drive.effort - account.target) <= most;
    account.disobeyed = obeys ? 0 : account.disobeyed + 1;
  }
}

void Cia402Host::take_frames() {
  can::Arrival arrival;
  while (link_->bus().receive(arrival) == can::ReceiveStatus::kReceived) group_->take(arrival);
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
  return mode_ == CyclicMode::kPosition ? group_->state(drive).position : 0.0;
}

// --- what drives are told ------------------------------------------------------------------------

/// Only of the kind that the drives are in: 0 of another kind could be a place to go to.
bool Cia402Host::set_target(int node, CyclicMode mode, double target) {
  const auto place = place_of(node);
  if (!place || mode != mode_ || !std::isfinite(target)) return false;
  group_->set_target(*place, target);
  accounts_[*place].target_at = time();
  accounts_[*place].target = target;
  accounts_[*place].dropped = false;
  return true;
}

bool Cia402Host::energize_drive(int node, bool enable, control::DrivePermit permit) {
  const auto place = place_of(node);
  if (!permit || !place || state() != component::State::kRunning) return false;
  group_->set_goal(*place, enable ? PowerGoal::kEnabled : PowerGoal::kSwitchedOn);
  return true;
}

bool Cia402Host::make_drive_safe(int node, bool quick_stop) {
  const auto place = place_of(node);
  if (!place) return false;
  group_->set_goal(*place, quick_stop ? PowerGoal::kQuickStop : PowerGoal::kOff);
  return true;
}

bool Cia402Host::reset_drive(int node) {
  const auto place = place_of(node);
  if (!place) return false;
  group_->ask_reset(*place);
  return true;
}

void Cia402Host::make_safe() {
  for (std::size_t i = 0; i < group_->size(); ++i) {
    group_->set_target(i, no_target(i));
    group_->set_goal(i, PowerGoal::kQuickStop);
  }
  static_cast<void>(group_->step(link_->bus(), link_->now()));
  rest();
}

std::optional<std::size_t> Cia402Host::place_of(int node) const {
  const bool known = node >= 1 && node <= kLastNode && group_;
  return known ? place_of_[static_cast<std::size_t>(node)] : std::nullopt;
}

}  // namespace armature::cia402
