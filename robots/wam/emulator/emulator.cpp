// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/emulator.hpp"

#include <algorithm>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/base/diagnostic.hpp"

namespace armature::wam {
namespace {

std::string check(const Emulator::Config& config, std::size_t motors) {
  if (motors != 4 && motors != kMostMotors) {
    return std::to_string(motors) + " motors, expected 4 or 7";
  }
  if (config.pucks.size() != motors) {
    return std::to_string(config.pucks.size()) + " pucks, expected one for each of " +
           std::to_string(motors) + " motors";
  }
  for (std::size_t motor = 0; motor < motors; ++motor) {
    const Puck::Config& puck = config.pucks[motor];
    const std::string name = "puck of motor " + std::to_string(motor + 1);
    if (puck.node != static_cast<int>(motor) + 1) {
      return name + " is node " + std::to_string(puck.node) + ", expected " +
             std::to_string(motor + 1);
    }
    if (puck.counts_per_turn <= 0 || puck.units_per_nm <= 0) {
      return name + " has counts_per_turn " + std::to_string(puck.counts_per_turn) +
             " and units_per_nm " + std::to_string(puck.units_per_nm) + ", expected above 0";
    }
  }
  return "";
}

}  // namespace

Emulator::Config Emulator::standard(std::size_t motors, int version) {
  Config config;
  for (std::size_t motor = 0; motor < motors; ++motor) {
    config.pucks.push_back(Puck::standard(static_cast<int>(motor) + 1, version));
  }
  return config;
}

base::Result<std::unique_ptr<Emulator>> Emulator::make(const Config& config, Motors& motors) {
  const std::string mistake = check(config, motors.count());
  if (!mistake.empty()) return base::Error{"emulated WAM on '" + config.bus_name + "': " + mistake};
  std::unique_ptr<Emulator> made(new Emulator(config, motors));
  base::Diagnostics diagnostics;
  if (!made->board_.switch_on(diagnostics)) return base::Error{base::as_reason(diagnostics)};
  return made;
}

Emulator::Emulator(const Config& config, Motors& motors)
    : motors_(motors),
      bus_(
          config.bus_name, config.bit_rate,
          config.clock ? config.clock : [this] { return bus_.now(); }),
      board_(config.board, bus_) {
  bus_.advance_to(config.begin);
  for (std::size_t motor = 0; motor < config.pucks.size(); ++motor) {
    pucks_.push_back(std::make_unique<Puck>(config.pucks[motor], bus_, motors_, motor));
  }
}

void Emulator::advance_to(base::Time until) {
  do {
    advance_to_next_event(until);
  } while (bus_.now() < until);
}

void Emulator::advance_to_next_event(base::Time until) {
  bus_.advance_to(std::min(next_event(), until));
  run_timers();
  motors_.advance_to(bus_.now());
}

void Emulator::run_timers() {
  board_.run_timers();
  if (std::exchange(powered_, board_.power()) != board_.power()) {
    for (const auto& puck : pucks_) puck->set_power(powered_);
  }
  for (const auto& puck : pucks_) puck->run_timers();
}

/// One event after the other, because each may move a deadline.
base::Time Emulator::next_event() {
  if (powered_ != board_.power()) return bus_.now();
  base::Time next = std::min(bus_.next_event().value_or(base::Time::max()), board_.next_deadline());
  for (const auto& puck : pucks_) next = std::min(next, puck->next_deadline());
  return next;
}

}  // namespace armature::wam
