// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/internal/operator_inputs.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "armature/component/checking/efforts.hpp"
#include "armature/component/interface.hpp"
#include "armature/document/value_tree.hpp"

namespace armature::deploy::internal {

using namespace document;
namespace {

using exec::Index;

class OperatorInputCheck {
 public:
  OperatorInputCheck(const exec::Blueprint& blueprint, const exec::Plan& plan)
      : blueprint_(blueprint), plan_(plan) {}

  /// Why nobody may write `input` by hand; empty if everybody may.
  std::string objection_to(const component::InputPortBase& input, Index owner) const {
    std::vector<Index> reached{owner};
    std::vector<Index> from{owner};
    for (std::size_t i = 0; i < reached.size(); ++i) {
      if (const std::string what = moving(reached[i]); !what.empty()) {
        return "'" + input.owner().name() + "." + input.name() + "' leads to " + what +
               way(reached, from, i);
      }
      for (const Index next : reached_from(reached[i])) {
        if (std::ranges::find(reached, next) != reached.end()) continue;
        reached.push_back(next);
        from.push_back(reached[i]);
      }
    }
    return {};
  }

 private:
  const component::Component& component(Index i) const {
    return *blueprint_.components[i].component;
  }

  std::vector<Index> reached_from(Index from) const {
    std::vector<Index> reached;
    for (const auto& one : plan_.connections) {
      if (one.from == from) reached.push_back(one.to);
    }
    for (const auto& one : plan_.calls) {
      if (one.caller == from) reached.push_back(one.callee);
    }
    for (const auto& one : plan_.subscriptions) {
      if (one.from == from) reached.push_back(one.to);
    }
    return reached;
  }

  /// What of the component moves something: it takes or gives an effort, or a permit to drive,
  /// holds something that would fall, or drives a real robot.
  std::string moving(Index i) const {
    const component::Interface& interface = component::interface_of(component(i));
    const auto named = [&](std::string_view member) {
      return "'" + component(i).name() + "." + std::string(member) + "'";
    };
    const auto of_port = [&](const component::PortBase& port) {
      return component::has_effort(port) ? named(port.name()) : std::string();
    };
    for (const component::InputPortBase* port : interface.inputs) {
      if (const std::string what = of_port(*port); !what.empty()) return what;
    }
    for (const component::OutputPortBase* port : interface.outputs) {
      if (const std::string what = of_port(*port); !what.empty()) return what;
    }
    for (const component::OperationBase* operation : interface.operations) {
      if (component::takes_effort(*operation)) return named(operation->name());
    }
    if (!interface.holdings.empty()) {
      return "'" + component(i).name() + "', which holds something";
    }
    const bool real = std::ranges::any_of(plan_.hardware, [&](const exec::HardwarePlan& one) {
      return one.component == &component(i);
    });
    return real ? "'" + component(i).name() + "', which drives a real robot" : std::string();
  }

  /// ` by 'Filter', 'Controller'`.
  std::string way(const std::vector<Index>& reached, const std::vector<Index>& from,
                  std::size_t end) const {
    std::string names;
    while (end != 0) {
      end = static_cast<std::size_t>(std::ranges::find(reached, from[end]) - reached.begin());
      names = "'" + component(reached[end]).name() + "'" + (names.empty() ? "" : ", ") + names;
    }
    return names.empty() ? names : " by " + names;
  }

  const exec::Blueprint& blueprint_;
  const exec::Plan& plan_;
};

}  // namespace

void check_operator_inputs(const Document& document, const exec::Blueprint& blueprint,
                           const exec::Plan& plan, base::Diagnostics& diagnostics) {
  if (document.operator_inputs.empty() || !diagnostics.ok()) return;
  const OperatorInputCheck check(blueprint, plan);
  for (const Connection& opened : document.operator_inputs) {
    const auto connects = [&](const exec::ConnectionPlan& one) {
      return one.entry->to_component == opened.to.component && one.entry->to_port == opened.to.port;
    };
    const auto found = std::ranges::find_if(plan.connections, connects);
    if (found == plan.connections.end()) continue;  // it is not there, which was reported
    if (std::ranges::count_if(plan.connections, connects) > 1) {
      diagnostics.error(opened.where,
                        "'" + to_text(opened.to) + "' of operator_inputs has a writer already",
                        "open only inputs that nothing writes");
    }
    const std::string objection = check.objection_to(*found->input, found->to);
    if (objection.empty()) continue;
    diagnostics.error(opened.where, objection + ": the operator may write only what moves nothing",
                      "remove it from operator_inputs; motions are commanded by a generator");
  }
}

}  // namespace armature::deploy::internal
