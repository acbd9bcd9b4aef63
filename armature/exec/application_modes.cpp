// SPDX-License-Identifier: Apache-2.0
// What modes are while an application runs.
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/exec/application.hpp"
#include "armature/exec/internal/directory.hpp"
#include "armature/exec/modes.hpp"

namespace armature::exec {
namespace {

using component::Outcome;

bool has(const Plan& plan, std::size_t mode, Index component) {
  return (plan.modes_of[component] >> mode & 1) != 0;
}

std::vector<Modes::Succession> successions(const Plan& plan, std::size_t from, std::size_t to) {
  std::vector<Modes::Succession> all;
  for (const component::InputPortBase* const input : plan.in_turns) {
    Modes::Succession each{};
    for (const ConnectionPlan& connection : plan.connections) {
      if (connection.input != input) continue;
      if (has(plan, from, connection.from)) each.leaving = connection.output;
      if (has(plan, to, connection.from)) each.entering = connection.output;
    }
    const bool changes = each.leaving != nullptr && each.entering != nullptr;
    if (changes && each.leaving != each.entering) all.push_back(each);
  }
  return all;
}

}  // namespace

Modes* Application::modes() const { return dynamic_cast<Modes*>(find(kModesName)); }

void Application::set_up_modes() {
  Modes* const switcher = modes();
  if (switcher == nullptr || plan_.modes.empty()) return;
  for (component::InputPortBase* input : plan_.in_turns) input->let_writers_take_turns();
  std::vector<Modes::Mode> all;
  for (std::size_t from = 0; from < plan_.modes.size(); ++from) {
    const ModePlan& plan = plan_.modes[from];
    Modes::Mode mode{plan.name, {}, {}};
    for (const Index member : plan.members) {
      mode.members.push_back(blueprint_.components[member].component.get());
    }
    for (std::size_t to = 0; to < plan_.modes.size(); ++to) {
      Modes::Way way{{}, successions(plan_, from, to)};
      for (auto member = plan.members.rbegin(); member != plan.members.rend(); ++member) {
        if (has(plan_, to, *member)) continue;
        way.leaving.push_back(blueprint_.components[*member].component.get());
      }
      mode.ways.push_back(std::move(way));
    }
    all.push_back(std::move(mode));
  }
  switcher->set_modes(std::move(all), plan_.initial_mode);
  switcher->begin(now());
}

Outcome Application::switch_mode(std::string_view name) {
  Modes* const switcher = modes();
  if (switcher == nullptr) return component::refused("the application has no modes");
  std::vector<std::string> names;
  for (const ModePlan& mode : plan_.modes) names.push_back(mode.name);
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    return component::refused("unknown mode " + internal::quoted(name) + " (" +
                              base::suggestion(name, names) + ")");
  }
  const auto outcome = std::make_shared<Outcome>(component::accepted());
  const auto work = [outcome, switcher, wanted = ModeName(name)] {
    *outcome = switcher->switch_to(wanted);
  };
  if (!running_) return component::refused("the application does not run");
  if (run_in_thread_of(*switcher, work)) return *outcome;
  return component::refused("the thread of the modes did not answer in time");
}

}  // namespace armature::exec
