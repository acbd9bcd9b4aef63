// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/remote_robot.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "armature/browser/internal/display.hpp"
#include "armature/browser/internal/plain_values.hpp"
#include "armature/types/elements.hpp"
#include "armature/types/type.hpp"

namespace armature::browser::internal {
namespace {

using namespace std::chrono_literals;
using remote::ComponentDetails;
using remote::ItemValue;

constexpr const char* kInspector = "armature";
/// An application that is asked while it stops, or waits for a component that hangs, takes seconds.
constexpr ride::CallOptions kPatient{.deadline = 15s, .priority = {}};
constexpr base::Duration kDirectoryLimit = 5s;

template <typename T>
void make_harmless(T& value) {
  types::visit_leaves(types::type_of<T>(), &value,
                      [](const std::string&, const types::Type& type, const void* leaf) {
                        if (!types::is_text(type)) return;
                        const std::string text = harmless(type.text(leaf));
                        // It is a part of `value`, which may be changed.
                        type.set_text(const_cast<void*>(leaf), text);
                      });
}

/// Without the placeholder's name and operation: who browses knows whom they have asked.
std::string problem_of(ride::Code code, const std::string& error) {
  const std::string begin = std::string(ride::name_of(code)) + ": ";
  const std::size_t at = error.find(begin);
  std::string text = at == std::string::npos ? error : error.substr(at + begin.size());
  if (code == ride::Code::kNotAllowed) text = "not allowed: " + text;
  return harmless(text);
}

}  // namespace

RemoteRobot::RemoteRobot(ride::Peer& peer)
    : peer_(peer), inspector_(peer, kInspector), watch_(peer.on_change([this](const auto& change) {
        const std::lock_guard lock(mutex_);
        changes_.push_back(change);
      })) {}

template <typename T>
T RemoteRobot::take(ride::Answer<T> answer) const {
  if (!answer.ok()) throw NoAnswer(problem_of(answer.code(), answer.error()));
  make_harmless(answer.value());
  return std::move(answer.value());
}

std::vector<ride::PeerChange> RemoteRobot::take_changes() {
  const std::lock_guard lock(mutex_);
  return std::exchange(changes_, {});
}

void RemoteRobot::forget() {
  hosted_.clear();
  has_application_.reset();
  names_.clear();
  known_.clear();
}

const std::vector<ride::PeerComponent>& RemoteRobot::hosted() {
  if (!hosted_.empty()) return hosted_;
  auto listed = peer_.components(kDirectoryLimit);
  if (!listed) throw NoAnswer(harmless(listed.error()));
  hosted_ = std::move(listed).value();
  for (ride::PeerComponent& one : hosted_) {
    one.name = harmless(one.name);
    one.interface = harmless(one.interface);
  }
  return hosted_;
}

bool RemoteRobot::has_application() {
  if (has_application_) return *has_application_;
  const auto& all = hosted();
  const bool listed = std::any_of(all.begin(), all.end(), [&](const ride::PeerComponent& one) {
    return one.name == kInspector && one.interface == inspector_.interface().name;
  });
  // The directory may know it before the placeholder has asked again.
  has_application_ =
      listed && inspector_.application(kPatient).code() != ride::Code::kNoSuchComponent;
  return *has_application_;
}

std::vector<std::string> RemoteRobot::component_names() {
  if (!names_.empty()) return names_;
  if (has_application()) {
    for (const remote::ComponentStatus& one : components()) names_.push_back(one.name);
  } else {
    for (const ride::PeerComponent& one : hosted()) names_.push_back(one.name);
  }
  return names_;
}

std::string RemoteRobot::find(std::string_view text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  if (quoted) text = text.substr(1, text.size() - 2);
  const std::vector<std::string> names = component_names();
  const auto found = std::find(names.begin(), names.end(), text);
  return found == names.end() ? std::string() : *found;
}

remote::ApplicationStatus RemoteRobot::status() { return take(inspector_.application(kPatient)); }

/// Of a node without an application there is no more to say than its directory does.
std::vector<remote::ComponentStatus> RemoteRobot::components() {
  if (has_application()) return take(inspector_.components(kPatient));
  std::vector<remote::ComponentStatus> all;
  for (const ride::PeerComponent& one : hosted()) {
    remote::ComponentStatus status;
    status.name = one.name;
    status.model = one.interface;
    all.push_back(status);
  }
  return all;
}

remote::Faults RemoteRobot::faults() { return take(inspector_.faults(kPatient)); }

void RemoteRobot::shorten(ComponentDetails& details) const {
  const auto all = [&](auto& members) {
    for (auto& one : members) {
      one.value = for_people(one.value, one.type, details.fields, kUsualElements);
    }
  };
  all(details.properties);
  all(details.inputs);
  all(details.outputs);
}

ComponentDetails RemoteRobot::look_at(const std::string& component) {
  ComponentDetails details = take(inspector_.describe(component, kPatient));
  known_[component] = details;
  shorten(details);
  return details;
}

ComponentDetails RemoteRobot::interface_of(const std::string& component) {
  const auto known = known_.find(component);
  return known != known_.end() ? known->second : look_at(component);
}

/// Only where there is a struct in it.
std::vector<remote::FieldDetails> RemoteRobot::fields_of(const ItemValue& value) {
  if (value.value.find('{') == std::string::npos) return {};
  const auto member = member_in(*this, value.item);
  if (!member) return {};
  return interface_of(member.value().component).fields;
}

std::vector<ItemValue> RemoteRobot::read(const std::vector<std::string>& items,
                                         std::size_t most_elements) {
  std::vector<ItemValue> values = take(inspector_.read(items, kPatient));
  for (ItemValue& one : values) {
    one.value = for_people(one.value, one.type, fields_of(one), most_elements);
  }
  return values;
}

Robot::Changed RemoteRobot::change(const std::string& component, const std::string& change) {
  auto answer = inspector_.change(component, change, kPatient);
  if (answer.ok()) return {{}, take(std::move(answer)).state};
  if (answer.code() != ride::Code::kFailed) take(std::move(answer));
  std::string state;
  for (const remote::ComponentStatus& one : components()) {
    if (one.name == component) state = one.state;
  }
  return {problem_of(answer.code(), answer.error()), state};
}

ItemValue RemoteRobot::write(const std::string& item, const std::string& value) {
  ItemValue now = take(inspector_.write(item, value, kPatient));
  now.value = for_people(now.value, now.type, fields_of(now), kAskedElements);
  return now;
}

std::string RemoteRobot::call(const std::string& component, const std::string& operation,
                              const std::vector<std::string>& arguments) {
  const remote::CallResult result =
      take(inspector_.call(component, operation, arguments, kPatient));
  return result.given ? for_people(result.value, result.type, {}, kAskedElements) : std::string();
}

remote::CommandStatus RemoteRobot::begin(const std::string& component, const std::string& command,
                                         const std::vector<std::string>& arguments) {
  return take(inspector_.begin(component, command, arguments, kPatient));
}

remote::CommandStatus RemoteRobot::follow(std::int32_t handle) {
  return take(inspector_.follow(handle, kPatient));
}

remote::CommandStatus RemoteRobot::cancel(std::int32_t handle) {
  return take(inspector_.cancel(handle, kPatient));
}

}  // namespace armature::browser::internal
