// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/emulator_report.hpp"

#include <algorithm>
#include <cstdio>

namespace armature::wam {
namespace {

const char* name_of(BoardMode mode) {
  switch (mode) {
    case BoardMode::kEstop:
      return "estop";
    case BoardMode::kIdle:
      return "idle";
    case BoardMode::kActive:
      return "active";
  }
  return "?";
}

const char* name_of(PuckState state) {
  switch (state) {
    case PuckState::kOff:
      return "off";
    case PuckState::kBooting:
      return "booting";
    case PuckState::kMonitor:
      return "monitor";
    case PuckState::kWaking:
      return "waking";
    case PuckState::kReady:
      return "ready";
  }
  return "?";
}

const char* name_of(PendantKey key) {
  switch (key) {
    case PendantKey::kEstop:
      return "estop";
    case PendantKey::kActivate:
      return "activate";
    case PendantKey::kIdle:
      return "idle";
    case PendantKey::kNone:
      return "none";
  }
  return "?";
}

const char* truth(bool value) { return value ? "true" : "false"; }

template <typename... Numbers>
std::string print(const char* format, Numbers... numbers) {
  char text[256];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

template <typename Values>
std::string joined(const EmulatorState& state, const char* format, const Values& values) {
  std::string all;
  for (std::size_t i = 0; i < state.motors; ++i) {
    all += (i > 0 ? "," : "") + print(format, values[i]);
  }
  return all;
}

std::string row(const EmulatorState& state, const char* name,
                const std::array<double, kMostMotors>& values) {
  std::string all = print("%-14s", name);
  for (std::size_t i = 0; i < state.motors; ++i) all += print(" %8.3f", values[i]);
  return all;
}

/// Those that are not safe.
std::string complaints(const PendantWord& pendant) {
  std::string all;
  for (std::size_t i = 0; i < kMonitors; ++i) {
    const auto monitor = static_cast<Monitor>(i);
    if (pendant.level(monitor) == Level::kSafe) continue;
    all += std::string(all.empty() ? "" : ", ") + to_text(monitor) + ' ' +
           to_text(pendant.level(monitor));
  }
  return all.empty() ? "all safe" : all;
}

const char* sentence_for(BoardMode mode) {
  switch (mode) {
    case BoardMode::kEstop:
      return "E-stop: the pucks have no power";
    case BoardMode::kIdle:
      return "idle: the pucks have power, the motors are braked";
    case BoardMode::kActive:
      return "active: the pucks obey torques";
  }
  return "?";
}

/// One line if all do the same, as they do when power comes or goes.
template <typename Tell>
void tell_pucks(const EmulatorState& before, const EmulatorState& state, Tell tell) {
  std::vector<std::size_t> changed;
  bool same = true;
  for (std::size_t i = 0; i < state.motors; ++i) {
    same = same && state.pucks[i] == state.pucks[0];
    if (state.pucks[i] != before.pucks[i]) changed.push_back(i);
  }
  if (same && changed.size() == state.motors) {
    tell(std::string("all pucks: ") + name_of(state.pucks[0]));
    return;
  }
  for (const std::size_t i : changed) {
    tell("puck " + std::to_string(i + 1) + ": " + name_of(state.pucks[i]));
  }
}

}  // namespace

std::string json_line(const EmulatorState& state, double time) {
  std::string monitors;
  for (std::size_t i = 0; i < kMonitors; ++i) {
    const auto monitor = static_cast<Monitor>(i);
    monitors += print(R"(%s"%s":"%s")", i > 0 ? "," : "", to_text(monitor),
                      to_text(state.pendant.level(monitor)));
  }
  std::string states;
  for (std::size_t i = 0; i < state.motors; ++i) {
    states += print(R"(%s"%s")", i > 0 ? "," : "", name_of(state.pucks[i]));
  }
  return print(R"({"time":%.6f,"mode":"%s","key":"%s","display":"%c",)", time, name_of(state.mode),
               name_of(state.pendant.key), state.pendant.display) +
         print(R"("lamps":{"activate":%s,"idle":%s},)", truth(state.pendant.activate_lamp),
               truth(state.pendant.idle_lamp)) +
         R"("monitors":{)" + monitors +
         print(R"(},"zeroed":%s,"carried":%s,"diverged":%s,)", truth(state.zeroed),
               truth(state.carried), truth(state.diverged)) +
         R"("position":[)" + joined(state, "%.9g", state.position) + R"(],"torque":[)" +
         joined(state, "%.9g", state.torque) + R"(],"pucks":[)" + states +
         print(R"(],"frames":%llu,"broken_frames":%llu})",
               static_cast<unsigned long long>(state.frames),
               static_cast<unsigned long long>(state.broken_frames));
}

std::array<std::string, kStatusLines> status_lines(const EmulatorState& state,
                                                   double frames_per_second) {
  const auto ready = std::count(state.pucks.begin(), state.pucks.end(), PuckState::kReady);
  const PendantWord& pendant = state.pendant;
  return {print("%-6s  display %c  lamps %c%c  %s", name_of(state.mode), pendant.display,
                pendant.activate_lamp ? 'A' : '-', pendant.idle_lamp ? 'I' : '-',
                complaints(pendant).c_str()) +
              print("  %s  %d of %zu ready  %.0f frames/s", state.zeroed ? "zeroed" : "not zeroed",
                    static_cast<int>(ready), state.motors, frames_per_second),
          row(state, "joints [rad]", state.position), row(state, "motors [N m]", state.torque)};
}

std::vector<std::string> EmulatorChanges::take(const EmulatorState& state, double time) {
  std::vector<std::string> changes;
  const auto tell = [&](const std::string& what) {
    changes.push_back(print("%10.3f s  ", time) + what);
  };
  if (!before_ || state.mode != before_->mode) {
    tell(std::string("board: ") + sentence_for(state.mode));
  }
  for (std::size_t i = 0; i < kMonitors; ++i) {
    const auto monitor = static_cast<Monitor>(i);
    const Level before = before_ ? before_->pendant.level(monitor) : Level::kSafe;
    if (state.pendant.level(monitor) == before) continue;
    tell(std::string("board: ") + to_text(monitor) + ' ' + to_text(state.pendant.level(monitor)));
  }
  if (before_ && state.zeroed != before_->zeroed) {
    tell(state.zeroed ? "board: positions are zeroed" : "board: positions are no longer zeroed");
  }
  if (before_) tell_pucks(*before_, state, tell);
  if (before_ && state.carried != before_->carried) {
    tell(state.carried ? "arm: is carried home" : "arm: is let go");
  }
  if (state.diverged && !(before_ && before_->diverged)) {
    tell("arm: its simulation has diverged and stands still; start the emulator again");
  }
  before_ = state;
  return changes;
}

}  // namespace armature::wam
