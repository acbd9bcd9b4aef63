// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/diagnostics.hpp"

#include "bridges/ros2/internal/dds.hpp"
#include "bridges/ros2/internal/messages.hpp"

namespace armature::ros2 {
namespace {

using component::State;

enum Level : std::uint8_t { kOk = 0, kWarn = 1, kError = 2 };

Level level_of(State state) {
  switch (state) {
    case State::kRunning:
      return kOk;
    case State::kException:
    case State::kRunTimeError:
      return kError;
    default:
      return kWarn;
  }
}

/// What a status says, until it is written.
struct Said {
  State state{};
  std::string message;
  std::string state_name;
  diagnostic_msgs_msg_dds__KeyValue_ value{};
};

Said look_at(const component::Component& component) {
  Said said;
  said.state = component.state();
  said.state_name = component::name_of(said.state);
  // Its thread may write the reason as long as it runs.
  const bool rests = said.state != State::kRunning && said.state != State::kRunTimeError;
  said.message = rests ? std::string(component.reason()) : std::string();
  if (said.message.empty()) said.message = said.state_name;
  return said;
}

}  // namespace

std::string Diagnostics::open(const component::Surroundings& surroundings) {
  components_ = surroundings.components;
  writer_ = writer(topic_, diagnostic_msgs_msg_dds__DiagnosticArray__desc, {.depth = 1});
  return {};
}

void Diagnostics::close() {
  writer_.reset();
  components_.clear();
}

void Diagnostics::work() {
  const std::string key = "state";
  const std::string no_frame;
  std::vector<Said> said;
  for (const component::Component* each : components_) said.push_back(look_at(*each));
  std::vector<diagnostic_msgs_msg_dds__DiagnosticStatus_> status(said.size());
  for (std::size_t i = 0; i < said.size(); ++i) {
    said[i].value.key = internal::lend(key);
    said[i].value.value = internal::lend(said[i].state_name);
    status[i].level = level_of(said[i].state);
    status[i].name = internal::lend(components_[i]->name());
    status[i].message = internal::lend(said[i].message);
    status[i].hardware_id = internal::lend(hardware_);
    status[i].values._length = status[i].values._maximum = 1;
    status[i].values._buffer = &said[i].value;
  }
  diagnostic_msgs_msg_dds__DiagnosticArray_ message{};
  message.header = internal::header_of(node().stamp_of(time()), no_frame);
  internal::lend(status, message.status);
  publish(*writer_, &message);
  tell();
}

}  // namespace armature::ros2
