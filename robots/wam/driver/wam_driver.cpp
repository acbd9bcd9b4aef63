// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/wam_driver.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <utility>

namespace armature::wam {
namespace {

constexpr std::uint32_t kDestinationBits = 0x41f;
/// Between two positions; cycles were not run if it is longer, and a motor that turns 100 rad/s may
/// come a quarter of a turn further.
constexpr base::Duration kLongestCompared = std::chrono::milliseconds(10);
constexpr base::Duration kShortestWatch = std::chrono::milliseconds(50);

bool usable(can::BusState state) {
  return state == can::BusState::kActive || state == can::BusState::kPassive;
}

/// Keeps the first that is not kSent.
void keep_first_failure(can::SendStatus& all, can::SendStatus next) {
  if (all == can::SendStatus::kSent) all = next;
}

std::string check(const WamRecord& arm, const WamDriver::Config& config) {
  if (arm.motors != 4 && arm.motors != kMostMotors) {
    return std::to_string(arm.motors) + " motors, expected 4 or 7";
  }
  for (std::size_t motor = 0; motor < arm.motors; ++motor) {
    const PuckRecord& puck = arm.pucks[motor];
    if (puck.counts_per_turn > 0 && puck.units_per_nm > 0 && puck.most_torque > 0) continue;
    return "nothing is known of puck " + std::to_string(motor + 1) +
           ", expected the record of a finished start-up";
  }
  if (config.reply_timeout <= base::Duration{}) return "reply_timeout is not above 0";
  if (config.torque_timeout <= base::Duration{}) return "torque_timeout is not above 0";
  if (config.most_without < 1) return "most_without is not above 0";
  if (config.watch_period < kShortestWatch) {
    return "watch_period is below 50 ms, what the safety board is to be asked for at most";
  }
  return "";
}

}  // namespace

base::Result<WamDriver> WamDriver::make(can::Bus& bus, const WamRecord& arm, const Config& config) {
  const std::string mistake = check(arm, config);
  if (!mistake.empty()) return base::Error{"WamDriver on bus '" + bus.name() + "': " + mistake};
  return WamDriver(bus, arm, config);
}

can::BusOptions WamDriver::bus_options() {
  can::BusOptions options;
  options.error_frames = true;
  for (const Group group : {Group::kPositions, Group::kReplies, Group::kJointPositions}) {
    options.filters.push_back({.id = identifier(to_group(group)), .mask = kDestinationBits});
  }
  options.filters.push_back({.id = identifier(from_node(kBoardNode, Group::kAll))});
  return options;
}

WamDriver::WamDriver(can::Bus& bus, const WamRecord& arm, const Config& config)
    : bus_(&bus),
      arm_(arm),
      config_(config),
      watch_({.mode_number = arm.board_mode_number,
              .pendant_number = arm.pendant_number,
              .period = config.watch_period}),
      pucks_(arm) {}

void WamDriver::start(base::Time now) {
  bus_offs_seen_ = bus_->counters().bus_offs;
  reading_ = WamReading::kNone;
  deadline_ = base::Time::max();
  fault_ = WamFault::kNone;
  fault_node_ = 0;
  cuts_power_ = board_heard_ = false;
  mode_seen_.reset();
  watch_.start(now);
  accounts_.fill({});
  for (std::size_t motor = 0; motor < arm_.motors; ++motor) {
    WamMotor anew;
    anew.node = arm_.pucks[motor].node;
    anew.counters = motors_[motor].counters;
    motors_[motor] = anew;
  }
}

// ---- Readings

WamReading WamDriver::begin_reading(base::Time now) {
  take_frames(now);
  if (reading_ == WamReading::kWaiting) finish(now);
  if (bus_was_lost()) return lose_bus();
  ask_positions(now);
  ask_board(now);
  if (nobody_asked()) finish(now);
  return reading_;
}

WamReading WamDriver::poll(base::Time now) {
  take_frames(now);
  if (reading_ != WamReading::kWaiting) return reading_;
  if (bus_was_lost()) return lose_bus();
  if (all_answered() || now >= deadline_) finish(now);
  return reading_;
}

/// Also when it has come back since: nothing of before is to go on as if nothing had happened.
bool WamDriver::bus_was_lost() const {
  return !usable(bus_->state()) || bus_->counters().bus_offs != bus_offs_seen_;
}

WamReading WamDriver::lose_bus() {
  ++bus_counters_.bus_lost;
  bus_offs_seen_ = bus_->counters().bus_offs;
  for (std::size_t motor = 0; motor < arm_.motors; ++motor) {
    motors_[motor].fresh = false;
    ++motors_[motor].cycles_without;
  }
  raise(WamFault::kNoBus);
  static_cast<void>(bus_->restart());
  return reading_ = WamReading::kNoBus;
}

/// All at once, or one by one without those that owe an answer.
void WamDriver::ask_positions(base::Time now) {
  bool all = true;
  for (std::size_t motor = 0; motor < arm_.motors; ++motor) {
    Account& account = accounts_[motor];
    account.asked = !account.owes;
    account.owes = account.jumped = false;
    motors_[motor].fresh = false;
    all = all && account.asked;
  }
  reading_ = WamReading::kWaiting;
  deadline_ = now + config_.reply_timeout;
  if (all) {
    send(get_frame(to_group(Group::kArm), arm_.position_number));
    return;
  }
  for (std::size_t motor = 0; motor < arm_.motors; ++motor) {
    if (accounts_[motor].asked) send(get_frame(to_node(motors_[motor].node), arm_.position_number));
  }
}

void WamDriver::ask_board(base::Time now) {
  const std::optional<can::Frame> question = watch_.question(now);
  if (question && send(*question) != can::SendStatus::kSent) watch_.take_back(now);
  if (watch_.silent()) raise(WamFault::kBoardSilent);
}

/// A puck that is silent is not asked for more.
void WamDriver::ask_puck(base::Time now) {
  if (fault_ != WamFault::kNone || reading_ != WamReading::kComplete) return;
  const std::optional<can::Frame> question = pucks_.question(now);
  if (question && send(*question) != can::SendStatus::kSent) pucks_.take_back();
}

bool WamDriver::nobody_asked() const { return std::ranges::none_of(accounts_, &Account::asked); }

bool WamDriver::all_answered() const {
  for (std::size_t motor = 0; motor < arm_.motors; ++motor) {
    const Account& account = accounts_[motor];
    if (account.asked && !account.jumped && !motors_[motor].fresh) return false;
  }
  return true;
}

void WamDriver::finish(base::Time now) {
  reading_ = WamReading::kComplete;
  for (std::size_t motor = 0; motor < arm_.motors; ++motor) {
    WamMotor& known = motors_[motor];
    Account& account = accounts_[motor];
    if (known.fresh) {
      known.cycles_without = 0;
      continue;
    }
    reading_ = WamReading::kIncomplete;
    ++known.cycles_without;
    account.owes = account.asked && !account.jumped;
    if (account.owes) ++known.counters.missed;
  }
  for (std::size_t motor = 0; motor < arm_.motors; ++motor) judge_silence(motor, now);
}

// ---- Frames

void WamDriver::take_frames(base::Time now) {
  can::Arrival arrival;
  while (bus_->receive(arrival) == can::ReceiveStatus::kReceived) {
    if (!arrival.own) take(arrival, now);
  }
}

void WamDriver::take(const can::Arrival& arrival, base::Time now) {
  if (arrival.frame.kind == can::FrameKind::kError) {
    ++bus_counters_.error_frames;
    return;
  }
  const std::optional<Address> address = address_of(arrival.frame);
  const int most = static_cast<int>(arm_.motors);
  if (address == from_node(kBoardNode, Group::kReplies)) {
    if (watch_.take(arrival.frame, now)) judge_board(now);
  } else if (address == from_node(kBoardNode, Group::kAll)) {
    watch_.hear(arrival.frame, now);
  } else if (address && address->group && address->to == static_cast<int>(Group::kPositions) &&
             address->from >= 1 && address->from <= most) {
    take_position(static_cast<std::size_t>(address->from - 1), arrival);
  } else if (address && address->group && address->to == static_cast<int>(Group::kReplies) &&
             address->from >= 1 && address->from <= most) {
    if (!pucks_.take(address->from, arrival.frame)) ++bus_counters_.unknown_frames;
  } else {
    ++bus_counters_.unknown_frames;
  }
}

void WamDriver::take_position(std::size_t motor, const can::Arrival& arrival) {
  WamMotor& known = motors_[motor];
  Account& account = accounts_[motor];
  const std::optional<Positions> positions = parse_positions(arrival.frame);
  if (!positions) {
    ++known.counters.malformed;
    return;
  }
  if (reading_ != WamReading::kWaiting || !account.asked || known.fresh || account.jumped) {
    account.owes = false;  // here it is
    ++known.counters.late;
    return;
  }
  const std::int32_t turn = arm_.pucks[motor].counts_per_turn;
  const bool recent = account.doubtful || arrival.time - known.position_time < kLongestCompared;
  const bool comparable = known.known && known.cycles_without < config_.most_without && recent;
  if (comparable && std::abs(positions->motor - known.counts) > turn / 4) {
    account.jumped = account.doubtful = true;
    ++known.counters.jumps;
    return;
  }
  known.counts = positions->motor;
  known.position = (positions->motor + 0.5) * 2.0 * std::numbers::pi / turn;
  known.joint_counts = positions->joint;
  known.position_time = arrival.time;
  known.known = known.fresh = true;
  account.doubtful = false;
}

// ---- Torques

void WamDriver::clear_torques() {
  for (Account& account : accounts_) account.torque = {};
}

WamTorque WamDriver::set_torque(std::size_t motor, double torque, base::Time now) {
  Account& account = accounts_[motor];
  WamCounters& counters = motors_[motor].counters;
  account.torque_time = now;
  account.torque.set(0.0);
  if (!std::isfinite(torque)) {
    ++counters.not_finite;
    return WamTorque::kNotFinite;
  }
  const PuckRecord& puck = arm_.pucks[motor];
  const double most = puck.most_torque;
  const double units = torque * puck.units_per_nm;
  account.torque.set(std::clamp(units, -most, most));
  if (std::abs(units) <= most) return WamTorque::kTaken;
  ++counters.limited;
  return WamTorque::kLimited;
}

can::SendStatus WamDriver::send_torques(base::Time now) {
  auto status = can::SendStatus::kSent;
  for (std::size_t first = 0; first < arm_.motors; first += kTorquesPerFrame) {
    Torques torques{};
    const std::size_t end = std::min(first + kTorquesPerFrame, arm_.motors);
    for (std::size_t motor = first; motor < end; ++motor) {
      torques[static_cast<std::size_t>(arm_.pucks[motor].slot - 1)] = torque_to_send(motor, now);
    }
    const Group group = first == 0 ? Group::kLowerArm : Group::kWrist;
    keep_first_failure(status, send(torque_frame(group, arm_.torque_number, torques)));
  }
  return status;
}

std::int16_t WamDriver::torque_to_send(std::size_t motor, base::Time now) {
  Account& account = accounts_[motor];
  if (!active() || account.torque.is_zero()) return 0;
  if (now < base::later(account.torque_time, config_.torque_timeout)) return account.torque.next();
  account.torque = {};
  ++motors_[motor].counters.stale;
  return 0;
}

can::SendStatus WamDriver::send_idle() {
  clear_torques();
  auto status = can::SendStatus::kSent;
  for (const Group group : {Group::kLowerArm, Group::kWrist}) {
    if (group == Group::kWrist && arm_.motors <= kTorquesPerFrame) continue;
    keep_first_failure(status, send(set_frame(to_group(group), arm_.motor_mode_number,
                                              static_cast<int>(PuckMode::kIdle))));
  }
  return status;
}

can::SendStatus WamDriver::send(const can::Frame& frame) {
  const can::SendStatus status = bus_->send(frame);
  if (status != can::SendStatus::kSent) ++bus_counters_.not_sent;
  return status;
}

}  // namespace armature::wam
