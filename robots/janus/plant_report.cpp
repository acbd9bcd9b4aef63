// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/plant_report.hpp"

#include <cstdio>

namespace armature::janus {
namespace {

const char* sentence_for(AicState state) {
  switch (state) {
    case AicState::kStarted:
      return "started";
    case AicState::kOff:
      return "actuator off";
    case AicState::kOn:
      return "actuator on";
    case AicState::kWatchdog:
      return "watchdog: the host is silent, actuator off";
    case AicState::kFault:
      return "fault: actuator off";
  }
  return "?";
}

std::string change_line(double time, std::size_t joint, double position, const char* what) {
  char text[128];
  std::snprintf(text, sizeof text, "%10.3f s  card %zu, at %6.3f rad: %s", time, joint + 1,
                position, what);
  return text;
}

}  // namespace

std::string json_line(const PlantState& state, double time) {
  static_assert(kJoints == 2);
  const auto truth = [](bool value) { return value ? "true" : "false"; };
  char text[256];
  std::snprintf(text, sizeof text,
                R"({"time":%.6f,"position":[%.9g,%.9g],"state":["%s","%s"],)"
                R"("brake_released":[%s,%s]})",
                time, state.position[0], state.position[1], to_text(state.cards[0]),
                to_text(state.cards[1]), truth(state.brake_released[0]),
                truth(state.brake_released[1]));
  return text;
}

std::vector<std::string> ChangeReport::take(const PlantState& state, double time) {
  std::vector<std::string> changes;
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    const double position = state.position[joint];
    if (!before_ || state.cards[joint] != before_->cards[joint]) {
      changes.push_back(change_line(time, joint, position, sentence_for(state.cards[joint])));
    }
    if (before_ && state.brake_released[joint] != before_->brake_released[joint]) {
      const char* const what = state.brake_released[joint] ? "brake released" : "brake applied";
      changes.push_back(change_line(time, joint, position, what));
    }
  }
  before_ = state;
  return changes;
}

}  // namespace armature::janus
