// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/transitions.hpp"

#include <memory>
#include <utility>

#include "armature/component/host.hpp"

namespace armature::exec::internal {

using component::Component;
using component::Outcome;

Outcome Transitions::change(std::string_view name, Transition transition) const {
  Component* const component = roster_.find(name);
  if (component == nullptr) return component::refused(roster_.unknown(name));
  const auto outcome = std::make_shared<Outcome>(component::accepted());
  const auto work = [outcome, component, transition = std::move(transition)] {
    *outcome = transition(*component);
  };
  if (executor_.run_in_thread_of(*component, work)) return *outcome;
  return component::refused(not_answered(*component));
}

Outcome Transitions::start(std::string_view name) const {
  return change(name, [modes = modes_.switcher()](Component& component) {
    Outcome outcome = modes == nullptr ? component::accepted() : modes->admit(component);
    const bool fresh = component.state() == component::State::kPreOperational;
    if (outcome && fresh) outcome = component::Host::configure(component);
    if (outcome && component.state() == component::State::kStopped)
      outcome = component::Host::activate(component);
    return outcome ? component::Host::start(component) : outcome;
  });
}

Outcome Transitions::stop(std::string_view name) const {
  return change(name, [](Component& component) {
    component::Host::stop(component);
    return component::accepted();
  });
}

Outcome Transitions::recover(std::string_view name) const {
  return change(name, [](Component& component) { return component::Host::recover(component); });
}

Outcome Transitions::reset(std::string_view name) const {
  return change(name, [](Component& component) { return component::Host::reset(component); });
}

Outcome Transitions::clean_up(std::string_view name) const {
  return change(name, [](Component& component) {
    if (component.state() != component::State::kStopped) {
      return component::refused("cannot be cleaned up: stop it first");
    }
    component::Host::cleanup(component);
    return component::accepted();
  });
}

}  // namespace armature::exec::internal
