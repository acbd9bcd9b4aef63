// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/wam_startup.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

namespace armature::wam {
namespace {

using std::chrono::milliseconds;

// Numbers that are the same for all kinds and versions.
constexpr int kVersNumber = 0;
constexpr int kRoleNumber = 1;
constexpr int kStatNumber = 5;

constexpr int kPresenceTries = 2;
constexpr int kAnswerTries = 3;
constexpr base::Duration kWakeGap = milliseconds(10);
constexpr base::Duration kWakeSilence = milliseconds(1000);
constexpr base::Duration kAwakeWindow = milliseconds(50);
constexpr base::Duration kIdlePoll = milliseconds(250);
constexpr base::Duration kBootPoll = milliseconds(500);
constexpr base::Duration kLimitGap = milliseconds(10);
constexpr int kIgnoredVelocities = 5;  // evaluations around a step of P
constexpr int kWristPoles = 6;
constexpr std::array kLimits{Property::kVl1, Property::kVl2, Property::kTl1, Property::kTl2};

std::string text(int number) { return std::to_string(number); }

constexpr int value_of(PuckStatus status) { return static_cast<int>(status); }

std::string check(const WamStartup::Config& config) {
  if (config.motors != 4 && config.motors != kMostMotors) {
    return std::to_string(config.motors) + " motors, expected 4 or 7";
  }
  for (std::size_t motor = 0; motor < config.motors; ++motor) {
    if (!std::isfinite(config.home[motor])) {
      return "home of motor " + std::to_string(motor + 1) + " is not a finite number";
    }
  }
  const base::Duration shortest = std::min({config.presence_window, config.answer_window});
  if (shortest <= base::Duration{}) return "presence_window or answer_window is not above 0";
  return "";
}

}  // namespace

base::Result<std::unique_ptr<WamStartup>> WamStartup::make(can::Bus& bus, const Config& config) {
  const std::string mistake = check(config);
  if (!mistake.empty()) return base::Error{"WAM on bus '" + bus.name() + "': " + mistake};
  return std::unique_ptr<WamStartup>(new WamStartup(bus, config));
}

WamStartup::WamStartup(can::Bus& bus, const Config& config)
    : config_(config), bus_name_(bus.name()), talk_(bus) {}

void WamStartup::connect(base::Time now) {
  talk_.forget();
  diagnostics_ = {};
  record_ = {};
  record_.motors = config_.motors;
  board_mode_.reset();
  idle_since_ = now;
  progress_ = WamProgress::kTalking;
  nodes_.fill({});
  enumerate(1);
}

WamProgress WamStartup::poll(base::Time now) {
  now_ = now;
  const bool talking = progress_ <= WamProgress::kWaitingForIdle;
  if (talking && !talk_.poll(now) && progress_ == WamProgress::kTalking) {
    progress_ = WamProgress::kDone;
  }
  return progress_;
}

void WamStartup::fail(const std::string& message, const std::string& hint) {
  progress_ = WamProgress::kFailed;
  talk_.forget();
  diagnostics_.error({}, "WAM on bus '" + bus_name_ + "': " + message, hint);
}

// ---- Who is there

void WamStartup::enumerate(int node) {
  if (node > kLastNode) return check_board();
  const bool needed = node <= static_cast<int>(kMostMotors) || node == kBoardNode;
  const Conversation::Patience patience{config_.presence_window, needed ? kPresenceTries : 1};
  talk_.ask(node, kStatNumber, patience, [this, node](std::optional<std::int32_t> status) {
    nodes_[static_cast<std::size_t>(node)] = {status};
    status ? note_found(node) : enumerate(node + 1);
  });
}

void WamStartup::note_found(int node) {
  const Conversation::Patience patience{config_.answer_window, kAnswerTries};
  Node& found = nodes_[static_cast<std::size_t>(node)];
  talk_.ask(node, kRoleNumber, patience, [&found](auto role) { found.role = role.value_or(-1); });
  talk_.ask(node, kVersNumber, patience, [this, node, &found](auto version) {
    found.version = version.value_or(-1);
    enumerate(node + 1);
  });
}

/// The limits are put back when the board is met first.
void WamStartup::check_board() {
  const Node& board = nodes_[kBoardNode];
  if (!board.status) {
    return fail("the safety board, node 10, does not answer; found " + found_nodes(),
                "check its power, the cable and the bit rate of 1 Mbit/s");
  }
  if ((board.role & kKindMask) != kSafetyRole) {
    return fail("node 10 has role " + text(board.role & kKindMask) + ", expected 2, a safety board",
                "give the safety board number 10 and nothing else");
  }
  if (board.version < 0) {
    return fail("the safety board does not tell its firmware's version, property 0",
                "check its power and the cable");
  }
  const bool met_before = board_mode_.has_value();
  record_.board_version = board.version;
  record_.board_mode_number = board_number(Property::kMode);
  record_.pendant_number = board_number(Property::kPen);
  record_.zero_number = board_number(Property::kZero);
  met_before ? check_pucks() : reset_limits(0);
}

std::string WamStartup::found_nodes() const {
  std::string nodes;
  for (std::size_t node = 1; node < nodes_.size(); ++node) {
    if (nodes_[node].status) nodes += (nodes.empty() ? "" : ", ") + std::to_string(node);
  }
  return nodes.empty() ? "no node" : "nodes " + nodes;
}

// ---- The safety board

/// Limits that an earlier program has left are not to go on.
void WamStartup::reset_limits(std::size_t limit) {
  if (limit == kLimits.size()) return wait_for_idle();
  const int number = board_number(kLimits[limit]);
  tell_board(Property::kDef, number);
  talk_.pause(kLimitGap);
  tell_board(Property::kLoad, number);
  talk_.pause(kLimitGap);
  ask_board(Property::kStat, [this, limit](std::int32_t) { reset_limits(limit + 1); });
}

void WamStartup::wait_for_idle() {
  ask_board(Property::kMode, [this](std::int32_t mode) {
    board_mode_ = static_cast<BoardMode>(mode);
    if (board_mode_ != BoardMode::kIdle) {
      progress_ = WamProgress::kWaitingForIdle;
      talk_.pause(kIdlePoll);
      return talk_.then([this] { wait_for_idle(); });
    }
    const bool waited = std::exchange(progress_, WamProgress::kTalking) != WamProgress::kTalking;
    idle_since_ = now_;
    waited ? enumerate(1) : check_pucks();
  });
}

// ---- The pucks

bool WamStartup::right_nodes() const {
  for (std::size_t node = 1; node <= kMostMotors; ++node) {
    if (nodes_[node].status.has_value() != (node <= config_.motors)) return false;
  }
  return true;
}

/// Pucks that have just got power may need a while.
void WamStartup::check_pucks() {
  if (!right_nodes()) {
    if (now_ - idle_since_ < config_.boot_timeout) {
      talk_.pause(kBootPoll);
      return talk_.then([this] { enumerate(1); });
    }
    return fail("found " + found_nodes() + ", expected motor pucks at exactly nodes 1 to " +
                    std::to_string(config_.motors),
                "check the cable to the missing puck, or how many joints the arm has");
  }
  for (std::size_t motor = 0; motor < config_.motors; ++motor) {
    const Node& node = node_of(motor);
    const auto mistake = check_motor(static_cast<int>(motor) + 1, node.role, *node.status);
    if (mistake) return fail(mistake->message, mistake->hint);
  }
  wake_pucks();
}

/// A puck that wakes up leaves the bus for a while, so nothing is sent then. It has lost its
/// position, whatever the board says.
void WamStartup::wake_pucks() {
  bool any = false;
  for (std::size_t motor = 0; motor < config_.motors; ++motor) {
    if (node_of(motor).status != value_of(PuckStatus::kReset)) continue;
    talk_.tell(
        set_frame(to_node(static_cast<int>(motor) + 1), kStatNumber, value_of(PuckStatus::kReady)));
    talk_.pause(kWakeGap);
    any = woken_ = true;
  }
  if (any) talk_.pause(kWakeSilence);
  talk_.then([this] { check_awake(0); });
}

void WamStartup::check_awake(std::size_t motor) {
  if (motor == config_.motors) return same_numbers() ? check_wrist() : void();
  if (node_of(motor).status == value_of(PuckStatus::kReady)) return check_awake(motor + 1);
  const int node = static_cast<int>(motor) + 1;
  const Conversation::Patience patience{kAwakeWindow, kAnswerTries};
  talk_.ask(node, kStatNumber, patience, [this, motor, node](auto status) {
    if (status != value_of(PuckStatus::kReady)) {
      return fail("puck " + text(node) + " did not wake up: status " +
                      (status ? text(*status) : "unknown, it does not answer") + ", expected 2",
                  "switch the arm off and on; if that does not help, the puck is broken");
    }
    node_of(motor).status = status;
    ask_puck(motor, Property::kVers, [this, motor](std::int32_t version) {
      node_of(motor).version = version;
      check_awake(motor + 1);
    });
  });
}

/// One request and one torque frame are for all, so they must have the same numbers.
bool WamStartup::same_numbers() {
  for (std::size_t motor = 0; motor < config_.motors; ++motor) {
    if (node_of(motor).version < 0) {
      fail(
          "puck " + std::to_string(motor + 1) + " does not tell its firmware's version, property 0",
          "check the cable to it");
      return false;
    }
    for (const Property property : {Property::kP, Property::kT}) {
      if (puck_number(motor, property) == puck_number(0, property)) continue;
      fail("puck " + std::to_string(motor + 1) + " has firmware " + text(node_of(motor).version) +
               " and puck 1 " + text(node_of(0).version) + ", which have different numbers for " +
               to_text(property),
           "give all pucks the same firmware");
      return false;
    }
  }
  record_.position_number = puck_number(0, Property::kP).value();
  record_.torque_number = puck_number(0, Property::kT).value();
  record_.motor_mode_number = puck_number(0, Property::kMode).value();
  return true;
}

/// The gimbals have puck 7, too, and another transmission.
void WamStartup::check_wrist() {
  constexpr std::size_t kLast = kMostMotors - 1;
  if (config_.motors < kMostMotors || !puck_number(kLast, Property::kPoles)) return read_puck(0);
  ask_puck(kLast, Property::kPoles, [this](std::int32_t poles) {
    if (poles == kWristPoles) return read_puck(0);
    fail("the motor of puck 7 has " + text(poles) + " poles, expected 6, those of the wrist",
         "8 are those of the gimbals, which this driver does not know");
  });
}

void WamStartup::read_puck(std::size_t motor) {
  if (motor == config_.motors) return finish_connect();
  PuckRecord& puck = record_.pucks[motor];
  puck.node = static_cast<int>(motor) + 1;
  puck.version = node_of(motor).version;
  puck.role = node_of(motor).role;
  const auto read = [this, motor](Property property, std::int32_t& into) {
    ask_puck(motor, property, [&into](std::int32_t value) { into = value; });
  };
  read(Property::kCts, puck.counts_per_turn);
  read(Property::kIpnm, puck.units_per_nm);
  read(Property::kMt, puck.most_torque);
  read(Property::kPidx, puck.slot);
  read(Property::kGrpa, puck.groups[0]);
  read(Property::kGrpb, puck.groups[1]);
  read(Property::kGrpc, puck.groups[2]);
  talk_.then([this, &puck, motor] {
    const std::optional<Mistake> mistake = check_puck(puck);
    mistake ? fail(mistake->message, mistake->hint) : read_puck(motor + 1);
  });
}

void WamStartup::finish_connect() {
  talk_.tell(set_frame(to_group(Group::kArm), record_.motor_mode_number,
                       static_cast<int>(PuckMode::kIdle)));
  ask_board(Property::kZero, [this](std::int32_t zero) {
    record_.zeroed = zero == 1 && !woken_;
    if (zero == 1 && woken_) tell_board(Property::kZero, 0);  // for whoever asks it next
  });
}

// ---- Zeroing

void WamStartup::zero(base::Time now) {
  if (progress_ != WamProgress::kDone) return;
  progress_ = WamProgress::kTalking;
  now_ = now;
  ask_board(Property::kZero, [this](std::int32_t zero) {
    record_.zeroed = zero == 1 && !woken_;
    record_.zeroed ? guard_first_reading() : write_home();
  });
}

/// Without a pause, so that the board sees one step and not several.
void WamStartup::write_home() {
  for (std::size_t motor = 0; motor < config_.motors; ++motor) {
    if (std::abs(home_in_counts(motor)) <= kMostCounts) continue;
    return fail("home of motor " + std::to_string(motor + 1) + " is " +
                    std::to_string(config_.home[motor]) + " rad, expected what fits into 22 bits",
                "give the angle of the motor's shaft at the home position in rad");
  }
  tell_board(Property::kIfault, kIgnoredVelocities);
  for (std::size_t motor = 0; motor < config_.motors; ++motor) {
    talk_.tell(set_frame(to_node(static_cast<int>(motor) + 1), record_.position_number,
                         static_cast<std::int32_t>(home_in_counts(motor))));
  }
  tell_board(Property::kZero, 1);
  ask_board(Property::kZero, [this](std::int32_t zero) {
    if (zero == 1) return check_home(0);
    fail("the safety board did not take ZERO 1, it has " + text(zero),
         "read what its pendant shows, and begin again");
  });
}

void WamStartup::check_home(std::size_t motor) {
  if (motor == config_.motors) {
    record_.zeroed = true;
    woken_ = false;
    return guard_first_reading();
  }
  const int node = static_cast<int>(motor) + 1;
  const Conversation::Patience patience{config_.answer_window, kAnswerTries};
  talk_.ask_position(node, record_.position_number, patience, [this, motor, node](auto counts) {
    const auto expected = static_cast<std::int32_t>(home_in_counts(motor));
    const std::int32_t most = record_.pucks[motor].counts_per_turn / 4;
    if (counts && std::abs(*counts - expected) <= most) return check_home(motor + 1);
    fail("puck " + text(node) + " is at " + (counts ? text(*counts) : "an unknown number of") +
             " counts after it was set to " + text(expected),
         "keep the arm still meanwhile, and begin again");
  });
}

/// The answer shows that the board has got it.
void WamStartup::guard_first_reading() {
  tell_board(Property::kIfault, kIgnoredVelocities);
  ask_board(Property::kStat, [](std::int32_t) {});
}

double WamStartup::home_in_counts(std::size_t motor) const {
  const double turns = config_.home[motor] / (2.0 * std::numbers::pi);
  return std::floor(turns * record_.pucks[motor].counts_per_turn);
}

// ---- Asking

std::optional<int> WamStartup::puck_number(std::size_t motor, Property property) const {
  return number_of(PuckKind::kMotor, nodes_[motor + 1].version, property);
}

int WamStartup::board_number(Property property) const {
  return number_of(PuckKind::kSafety, nodes_[kBoardNode].version, property).value_or(-1);
}

void WamStartup::ask_puck(std::size_t motor, Property property,
                          std::function<void(std::int32_t)> then) {
  const std::string name =
      "puck " + std::to_string(motor + 1) + " with firmware " + text(node_of(motor).version);
  const std::optional<int> number = puck_number(motor, property);
  if (!number) {
    return fail(name + " has no property " + to_text(property), "give it newer firmware");
  }
  const auto answered = [this, name, property, number, then = std::move(then)](auto value) {
    if (value) return then(*value);
    fail(name + " does not answer to " + to_text(property) + ", property " + text(*number),
         "check its cable, and that the firmware is what VERS says");
  };
  talk_.ask(static_cast<int>(motor) + 1, *number, {config_.answer_window, kAnswerTries}, answered);
}

void WamStartup::ask_board(Property property, std::function<void(std::int32_t)> then) {
  const int number = board_number(property);
  const auto answered = [this, property, number, then = std::move(then)](auto value) {
    if (value) return then(*value);
    fail("the safety board with firmware " + text(record_.board_version) + " does not answer to " +
             to_text(property) + ", property " + text(number),
         "check its power and the cable");
  };
  talk_.ask(kBoardNode, number, {config_.answer_window, kAnswerTries}, answered);
}

void WamStartup::tell_board(Property property, std::int32_t value) {
  talk_.tell(set_frame(to_node(kBoardNode), board_number(property), value));
}

}  // namespace armature::wam
