// SPDX-License-Identifier: Apache-2.0
#include "armature/component/states/state_definition.hpp"

namespace armature::component {
namespace internal {

void set(MachineAction& action, void (*call)(void* self), std::string_view signature) noexcept {
  action.call = call;
  action.name = function_name(signature);
}

void set(MachineGuard& guard, bool (*call)(void* self), std::string_view signature) noexcept {
  guard.call = call;
  guard.name = function_name(signature);
}

}  // namespace internal

TransitionDefinition::TransitionDefinition(MachineTransition::Cause cause) noexcept {
  transition.cause = cause;
}

TransitionDefinition::TransitionDefinition(const TransitionDefinition&) = default;
TransitionDefinition::TransitionDefinition(TransitionDefinition&&) noexcept = default;
TransitionDefinition::~TransitionDefinition() = default;

void TransitionDefinition::apply(To option) noexcept {
  target = option.state;
  transition.to_history = option.history;
}

StateDefinition::StateDefinition(std::string_view name) noexcept { state.name = name; }

StateDefinition::StateDefinition(const StateDefinition&) = default;
StateDefinition::StateDefinition(StateDefinition&&) noexcept = default;
StateDefinition::~StateDefinition() = default;

void StateDefinition::apply(std::string_view doc) noexcept { state.doc = doc; }

void StateDefinition::apply(StateDefinition&& substate) noexcept {
  substates.push_back(std::move(substate));
}

void StateDefinition::apply(TransitionDefinition&& definition) noexcept {
  transitions.push_back(std::move(definition));
}

}  // namespace armature::component
