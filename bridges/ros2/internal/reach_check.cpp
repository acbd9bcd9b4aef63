// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/internal/reach_check.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "armature/component/checking/efforts.hpp"
#include "armature/component/events/event.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/operations/operation.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"

namespace armature::ros2::internal {
namespace {

using component::Component;

/// Those of motions, which are not the operator's alone.
bool takes_commands(const Component& component) {
  return std::ranges::any_of(component::interface_of(component).operations,
                             [](const component::OperationBase* each) {
                               return each->is_command() && !each->is_by_operator();
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
  std::vector<const Component*> commanded() && { return std::move(commanded_); }

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
    if (component::has_effort(input)) return refuse(input.owner(), input.name());
    enter(input.owner());
  }
  void enter(const component::OperationBase& operation) {
    if (component::takes_effort(operation)) return refuse(operation.owner(), operation.name());
    enter(operation.owner());
  }
  void enter(const Component& component) {
    const bool commanded = takes_commands(component);
    if (commanded) add(component, commanded_);
    if (!commanded || brakes(component, check_) == nullptr) add(component, reached_);
  }

  static void add(const Component& component, std::vector<const Component*>& to) {
    if (std::ranges::find(to, &component) == to.end()) to.push_back(&component);
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
  std::vector<const Component*> commanded_;
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
  return std::move(reach).commanded();
}

}  // namespace armature::ros2::internal
