// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/local_robot.hpp"

#include "armature/browser/internal/display.hpp"
#include "armature/inspect/items.hpp"
#include "armature/lua/names.hpp"
#include "armature/remote/inspection.hpp"

namespace armature::browser::internal {
namespace {

remote::ToText for_people(std::size_t most_elements) {
  return [most_elements](const types::Type& type, const void* value) {
    return value_text(type, value, {}, most_elements);
  };
}

}  // namespace

std::vector<std::string> LocalRobot::component_names() {
  return inspect::component_names(application_);
}

std::string LocalRobot::find(std::string_view text) {
  const component::Component* const found = application_.find(lua::without_lua(text));
  return found == nullptr ? std::string() : found->name();
}

std::string LocalRobot::spelled(const std::string& component) const {
  return lua::in_lua(component);
}

remote::ApplicationStatus LocalRobot::status() { return remote::status_of(application_); }

std::vector<remote::ComponentStatus> LocalRobot::components() {
  return remote::statuses_of(application_, remote::all_components(application_));
}

remote::Faults LocalRobot::faults() {
  return remote::faults_of(application_, remote::all_components(application_));
}

remote::ComponentDetails LocalRobot::look_at(const std::string& component) {
  return remote::details_of(application_, *application_.find(component),
                            for_people(kUsualElements));
}

remote::ComponentDetails LocalRobot::interface_of(const std::string& component) {
  return remote::details_of(application_, *application_.find(component), {});
}

std::vector<remote::ItemValue> LocalRobot::read(const std::vector<std::string>& items,
                                                std::size_t most_elements) {
  std::vector<std::string> plain;
  for (const std::string& item : items) plain.push_back(lua::without_lua(item));
  std::vector<remote::ItemValue> values =
      remote::values_of(application_, plain, for_people(most_elements));
  // Ages are for whoever looks from another process, beside whom no log runs.
  for (remote::ItemValue& value : values) value.age = 0.0;
  return values;
}

Robot::Changed LocalRobot::change(const std::string& component, const std::string& change) {
  const auto outcome = [&] {
    if (change == "start") return application_.start_component(component);
    if (change == "stop") return application_.stop_component(component);
    if (change == "cleanup") return application_.clean_up_component(component);
    if (change == "reset") return application_.reset_component(component);
    return application_.recover_component(component);
  }();
  return {outcome ? std::string() : component + ": " + std::string(outcome.reason()),
          std::string(component::name_of(application_.find(component)->state()))};
}

}  // namespace armature::browser::internal
