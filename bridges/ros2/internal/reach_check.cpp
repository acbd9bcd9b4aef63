// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/internal/reach_check.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "armature/base/unit.hpp"
#include "armature/component/events/event.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/operations/operation.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"

namespace armature::ros2::internal {
namespace {

using component::Component;

bool is_effort(std::string_view text) {
  constexpr std::string_view kOr = " or ";  // of axes of both kinds: "Nm or N"
  if (const auto at = text.find(kOr); at != std::string_view::npos) {
    return is_effort(text.substr(0, at)) || is_effort(text.substr(at + kOr.size()));
  }
  const auto unit = base::parse_unit(text);
  if (!unit) return false;
  return std::ranges::any_of(std::array{"V", "A", "N", "N m", "W"}, [&](const char* effort) {
    return base::parse_unit(effort).value().same_kind(unit.value());
  });
}

bool has_effort(const types::Type& type) {
  if (type.sealed) return true;
  if (type.element != nullptr) return has_effort(*type.element);
  return std::ranges::any_of(type.fields, [](const types::Field& field) {
    return is_effort(field.unit) || has_effort(*field.type);
  });
}

bool moves(const component::PortBase& port) {
  return is_effort(port.unit()) || has_effort(port.type());
}

/// Those of motions, which are not the operator's alone.
bool takes_commands(const Component& component) {
  return std::ranges::any_of(component::interface_of(component).operations,
                             [](const component::OperationBase* each) {
                               return each->is_command() && !each->is_by_operator();
                             });
}

/// `N m` of `torque [N m]`; empty if it has no unit.
std::string_view unit_of(std::string_view argument) {
  const std::size_t open = argument.find(" [");
  if (open == std::string_view::npos || !argument.ends_with(']')) return {};
  return argument.substr(open + 2, argument.size() - open - 3);
}

bool takes_effort(const component::OperationBase& operation) {
  return std::ranges::any_of(operation.signature().arguments, [](const auto& each) {
    return is_effort(unit_of(each.name)) || has_effort(*each.type);
  });
}

class Reach {
 public:
  explicit Reach(component::Check& check) : check_(check) {
    for (const Component* each : check.components()) {
      for (const auto* handler : component::interface_of(*each).handlers) {
        if (const auto* event = check.source_of(*handler))
          told_by_[&event->owner()].push_back(each);
      }
    }
  }

  /// @param input  that `from` writes beside its outputs; nullptr: none
  void follow(const Component& from, const component::InputPortBase* input) {
    reached_.push_back(&from);
    if (input != nullptr) enter(*input);
    for (std::size_t i = 0; i < reached_.size() && !refused_; ++i) follow_one(*reached_[i]);
  }
  std::vector<const Component*> keepers() && { return std::move(keepers_); }

 private:
  void follow_one(const Component& component) {
    const component::Interface& interface = component::interface_of(component);
    for (const auto* output : interface.outputs) {
      for (const auto* input : check_.readers_of(*output)) enter(*input);
    }
    for (const auto* caller : interface.callers) {
      if (const auto* target = check_.target_of(*caller)) enter(*target);
    }
    if (const auto told = told_by_.find(&component); told != told_by_.end()) {
      for (const Component* each : told->second) enter(*each);
    }
  }

  void enter(const component::InputPortBase& input) {
    if (moves(input)) return refuse(input.owner(), input.name());
    enter(input.owner());
  }
  void enter(const component::OperationBase& operation) {
    if (takes_effort(operation)) return refuse(operation.owner(), operation.name());
    enter(operation.owner());
  }
  void enter(const Component& component) {
    if (takes_commands(component) && brakes(component, check_) != nullptr) {
      if (std::ranges::find(keepers_, &component) == keepers_.end()) keepers_.push_back(&component);
    } else if (std::ranges::find(reached_, &component) == reached_.end()) {
      reached_.push_back(&component);
    }
  }

  /// Once: the first is enough to mend.
  void refuse(const Component& owner, std::string_view member) {
    if (std::exchange(refused_, true)) return;
    check_.error("what comes from ROS 2 leads to the effort '" + owner.name() + "." +
                     std::string(member) + "'",
                 "connect it to a generator of motions or to a chassis, which keep limits and have "
                 "Arming among their peers");
  }

  component::Check& check_;
  std::map<const Component*, std::vector<const Component*>> told_by_;
  std::vector<const Component*> reached_;
  std::vector<const Component*> keepers_;
  bool refused_ = false;
};

}  // namespace

const Component* brakes(const Component& component, const component::Check& check) {
  for (const auto* handler : component::interface_of(component).handlers) {
    if (handler->name() != "Stop") continue;
    if (const auto* event = check.source_of(*handler)) return &event->owner();
  }
  return nullptr;
}

std::vector<const Component*> check_reach(const Component& from,
                                          const component::InputPortBase* input,
                                          component::Check& check) {
  Reach reach(check);
  reach.follow(from, input);
  return std::move(reach).keepers();
}

}  // namespace armature::ros2::internal
