// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/registry.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/types/enum.hpp"

namespace armature::inspect {

using types::name_of;

/// What stands at the other end of a connection.
enum class EndKind { kInput, kOutput, kEvent, kCommand };
ARMATURE_ENUM(EndKind, kInput, kOutput, kEvent, kCommand);

/// What a component has to be told before a connection fits: `Unit: rad`.
struct UnitToName {
  std::string property;  ///< empty: nothing
  std::string unit;
};

/// Where a connection from, or to, a member could end.
struct End {
  std::string component;  ///< its full name, or that of a model
  std::string member;
  EndKind kind = EndKind::kInput;
  std::string why_not;  ///< empty: it fits
  UnitToName names{};   ///< with which it fits

  bool fits() const { return why_not.empty(); }
};

/// All ends of the kind that `component.member` can be connected to: inputs for an output, outputs
/// for an input, commands for an event, events for a command. An input with a writer fits where
/// several may write, or where modes could have them take turns, which the check decides. A port of
/// any unit fits if nothing is connected to its component yet: `End::names` says what to set.
/// The error says that there is no such member.
/// @thread any, while the components do not run; O(ports of the application)
base::Result<std::vector<End>> fitting(const exec::Blueprint& blueprint, std::string_view component,
                                       std::string_view member);

/// Ports of models, as their defaults have them, that fit a port of a deployment.
class ModelPorts {
 public:
  /// Makes a component of each model; those whose constructor throws are left out.
  explicit ModelPorts(const component::Registry& registry);

  /// Those that fit alone; none for events and commands.
  std::vector<End> fitting(const exec::Blueprint& blueprint, std::string_view component,
                           std::string_view member) const;

 private:
  exec::Blueprint models_;  ///< a component of each, under its model's name
};

}  // namespace armature::inspect
