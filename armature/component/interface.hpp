// SPDX-License-Identifier: Apache-2.0
#pragma once

// What a component declares, for the runtime and for tools.

#include <vector>

namespace armature::component {

class Component;
class PropertyBase;
class InputPortBase;
class OutputPortBase;
class PortArrayBase;
class OperationBase;
class OperationCallerBase;
class EventBase;
class EventHandlerBase;
class StateMachine;
class Observer;
class Checked;
class Holding;

/// What a component declares, in the order of declaration.
struct Interface {
  std::vector<PropertyBase*> properties;
  std::vector<PropertyBase*> mandatory;  ///< those of them that a deployment must give
  std::vector<InputPortBase*> inputs;
  std::vector<OutputPortBase*> outputs;
  std::vector<PortArrayBase*> port_arrays;
  std::vector<OperationBase*> operations;
  std::vector<OperationCallerBase*> callers;
  std::vector<EventBase*> events;
  std::vector<EventHandlerBase*> handlers;
  std::vector<StateMachine*> machines;
  std::vector<Observer*> observers;
  std::vector<const Checked*> checked;
  std::vector<Holding*> holdings;
};

/// What `component` declares.
const Interface& interface_of(const Component& component);

}  // namespace armature::component
