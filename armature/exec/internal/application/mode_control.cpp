// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/mode_control.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/base/quoted.hpp"

namespace armature::exec::internal {
namespace {

using component::Outcome;

bool has(const Plan& plan, std::size_t mode, Index component) {
  return (plan.modes_of[component] >> mode & 1) != 0;
}

/// Who follows whom at inputs that drive: what a shadow reads in turns says nothing of what the
/// entering output takes over.
std::vector<Modes::Succession> successions(const Blueprint& blueprint, const Plan& plan,
                                           std::size_t from, std::size_t to) {
  std::vector<Modes::Succession> all;
  for (const component::InputPortBase* const input : plan.in_turns) {
    Modes::Succession each{};
    for (const ConnectionPlan& connection : plan.connections) {
      if (connection.input != input || blueprint.components[connection.to].shadow) continue;
      if (has(plan, from, connection.from)) each.leaving = connection.output;
      if (has(plan, to, connection.from)) each.entering = connection.output;
    }
    const bool changes = each.leaving != nullptr && each.entering != nullptr;
    if (changes && each.leaving != each.entering) all.push_back(each);
  }
  return all;
}

}  // namespace

Modes* ModeControl::switcher() const { return dynamic_cast<Modes*>(roster_.find(kModesName)); }

void ModeControl::set_up(base::Time now) const {
  Modes* const modes = switcher();
  if (modes == nullptr || plan_.modes.empty()) return;
  for (component::InputPortBase* input : plan_.in_turns) input->let_writers_take_turns();
  std::vector<Modes::Mode> all;
  for (std::size_t mode = 0; mode < plan_.modes.size(); ++mode) all.push_back(mode_of(mode));
  modes->set_modes(std::move(all), plan_.initial_mode);
  modes->begin(now);
}

Modes::Mode ModeControl::mode_of(std::size_t number) const {
  const ModePlan& plan = plan_.modes[number];
  Modes::Mode mode{plan.name, {}, {}};
  for (const Index member : plan.members) {
    mode.members.push_back(blueprint_.components[member].component.get());
  }
  for (std::size_t to = 0; to < plan_.modes.size(); ++to) {
    Modes::Way way{{}, successions(blueprint_, plan_, number, to)};
    for (auto member = plan.members.rbegin(); member != plan.members.rend(); ++member) {
      if (has(plan_, to, *member)) continue;
      way.leaving.push_back(blueprint_.components[*member].component.get());
    }
    mode.ways.push_back(std::move(way));
  }
  return mode;
}

Outcome ModeControl::switch_to(std::string_view name) const {
  Modes* const modes = switcher();
  if (modes == nullptr) return component::refused("the application has no modes");
  std::vector<std::string> names;
  for (const ModePlan& mode : plan_.modes) names.push_back(mode.name);
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    return component::refused("unknown mode " + base::quoted(name) +
                              base::suggestion_in_brackets(name, names));
  }
  const auto outcome = std::make_shared<Outcome>(component::accepted());
  const auto work = [outcome, modes, wanted = ModeName(name)] {
    *outcome = modes->switch_to(wanted);
  };
  if (!health_.running()) return component::refused("the application does not run");
  if (executor_.run_in_thread_of(*modes, work)) return *outcome;
  return component::refused("the thread of the modes did not answer in time");
}

}  // namespace armature::exec::internal
