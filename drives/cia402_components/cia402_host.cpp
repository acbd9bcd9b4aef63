// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402_components/cia402_host.hpp"

#include <chrono>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/base/seconds.hpp"
#include "armature/controllers/base/max_age.hpp"
#include "drives/canopen/count_devices.hpp"
#include "drives/canopen/nmt.hpp"
#include "drives/canopen/sdo_channel.hpp"
#include "drives/cia402/bus_time.hpp"
#include "drives/cia402/compare_eds.hpp"
#include "drives/cia402/prepare_drive.hpp"
#include "drives/cia402_components/cia402_drive.hpp"

namespace armature::cia402 {

using component::Outcome;

namespace {

using namespace std::chrono_literals;

/// In which a drive takes a command of NMT.
constexpr base::Duration kNmtTime = 5ms;
constexpr int kLastNode = 127;

void pass_time(can::Link& link, base::Duration time) {
  const base::Time until = link.now() + time;
  while (link.now() < until) link.wait_for_news(until);
}

}  // namespace

// --- what the deployment says --------------------------------------------------------------------

void Cia402Host::on_check(component::Check& check) const {
  check_nodes(check);
  plan_drives(check);
  check_bus_time(check);
}

void Cia402Host::check_nodes(component::Check& check) const {
  if (nodes_.get().empty()) check.error("nodes is empty", "name the numbers of the drives");
  std::set<int> seen;
  for (const int node : nodes_.get()) {
    const std::string has = "nodes has " + std::to_string(node);
    if (node < 1 || node > kLastNode) check.error(has, "numbers of drives are 1 to 127");
    if (!seen.insert(node).second) check.error(has + " twice", "name each drive once");
  }
}

/// What the bus says of all drives, and each of itself.
void Cia402Host::plan_drives(component::Check& check) const {
  plans_.clear();
  std::map<int, const Cia402Drive*> known;
  for (const component::Component* const each : check.components()) {
    const auto* const drive = dynamic_cast<const Cia402Drive*>(each);
    if (drive == nullptr || !drive->is_on(*this, check)) continue;
    const auto [first, is_new] = known.emplace(drive->node(), drive);
    if (is_new) continue;
    check.error("drives '" + first->second->name() + "' and '" + drive->name() +
                    "' both have node " + std::to_string(drive->node()),
                "give each drive its own number");
  }
  base::Diagnostics diagnostics;
  for (const int node : nodes_.get()) {
    DrivePlan plan = plan_of(node);
    if (const auto found = known.find(node); found != known.end()) found->second->refine(plan);
    plan.read_eds(diagnostics);
    plans_.push_back(std::move(plan));
  }
  for (const base::Diagnostic& each : diagnostics.all()) {
    const std::string place = each.where.file.empty() ? "" : each.where.file + ": ";
    check.error(place + each.message, each.hint);
  }
}

DrivePlan Cia402Host::plan_of(int node) const {
  DrivePlan plan;
  plan.wish = {.node = static_cast<canopen::NodeId>(node),
               .name = name() + "." + std::to_string(node),
               .mode = mode_of(mode_),
               .unit = unit_ == DriveUnit::kFeed ? PositionUnit::kFeed : PositionUnit::kIncrements,
               .cycle = cycle(),
               .heartbeat = base::from_seconds(heartbeat_)};
  plan.mode = mode_;
  plan.eds_file = eds_;
  plan.expect(vendor_, product_);
  return plan;
}

void Cia402Host::check_bus_time(component::Check& check) const {
  if (cycle() <= base::Duration{}) return;
  std::vector<DriveWish> wishes;
  for (const DrivePlan& plan : plans_) wishes.push_back(plan.wish);
  const base::Duration needed = cycle_bus_time(wishes, bit_rate());
  if (needed <= cycle()) return;
  const auto text_of = [](base::Duration duration) {
    component::Reason text;
    return std::string(controllers::append_duration(text, duration).view());
  };
  check.error("the frames of a cycle of " + std::to_string(wishes.size()) + " drives take up to " +
                  text_of(needed) + " at " + std::to_string(bit_rate()) +
                  " bit/s, and a cycle has " + text_of(cycle()),
              "raise bit_rate, lengthen the period, or put drives on another bus");
}

// --- the start -----------------------------------------------------------------------------------

Outcome Cia402Host::on_configure() {
  if (Outcome outcome = period_.known(); !outcome) return outcome;
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

void Cia402Host::find_places() {
  place_of_.assign(kLastNode + 1, std::nullopt);
  for (std::size_t i = 0; i < nodes_.get().size(); ++i) {
    place_of_[static_cast<std::size_t>(nodes_.get()[i])] = i;
  }
  accounts_.assign(nodes_.get().size(), {});
}

/// All that is wrong with all drives is told at once.
Outcome Cia402Host::prepare() {
  using canopen::NmtCommand;
  link_->bus().send(canopen::nmt_frame(NmtCommand::kEnterPreOperational, canopen::kEveryNode));
  pass_time(*link_, kNmtTime);
  base::Diagnostics diagnostics;
  std::vector<DriveConfig> configs;
  for (const DrivePlan& plan : plans_) {
    if (auto config = prepare(plan, diagnostics)) configs.push_back(*std::move(config));
  }
  if (!diagnostics.ok()) return component::refused(base::as_reason(diagnostics));
  auto group = DriveGroup::make(std::move(configs));
  if (!group) return component::refused(group.error());
  group_.emplace(std::move(group).value());
  link_->bus().send(canopen::nmt_frame(NmtCommand::kStart, canopen::kEveryNode));
  pass_time(*link_, kNmtTime);
  return component::accepted();
}

std::optional<DriveConfig> Cia402Host::prepare(const DrivePlan& plan,
                                               base::Diagnostics& diagnostics) {
  const DriveWish& wish = plan.wish;
  if (const int devices = canopen::count_devices(*link_, wish.node); devices > 1) {
    diagnostics.error({},
                      "drive '" + wish.name + "', node " + std::to_string(wish.node) + ": " +
                          std::to_string(devices) + " devices answer as this node, expected one",
                      std::string("give each device on the bus its own number"));
    return std::nullopt;
  }
  canopen::SdoChannel channel(*link_, wish.node);
  const bool is_described =
      !plan.eds || compare_with_eds(channel, *plan.eds, plan.eds_file, wish, diagnostics);
  return is_described ? prepare_drive(channel, wish, diagnostics) : std::nullopt;
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
  sample.reboots = static_cast<int>(drive.reboots);
  sample.error_code = drive.emergency ? drive.emergency->code : drive.error_code;
  sample.lost = drive.presence == canopen::Presence::kLost;
  sample.warns = drive.warns();
  sample.limited = drive.limited();
  account.seen = drive.time;
  return sample;
}

void Cia402Host::begin_cycle() {
  cycle_at_ = time();
  link_->begin_cycle(time());
  take_frames();
  drop_old_targets();
  const std::size_t refused = group_->step(link_->bus(), link_->now());
  if (refused > 0) refused_frames_.assign(refused_frames_() + static_cast<int>(refused));
  int silent = 0;
  for (std::size_t i = 0; i < group_->size(); ++i) silent += group_->state(i).silent_cycles > 1;
  if (silent > 0) lost_answers_.assign(lost_answers_() + silent);
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
    if (old && !std::exchange(account.dropped, true)) group_->set_target(i, no_target(i));
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
