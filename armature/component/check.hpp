// SPDX-License-Identifier: Apache-2.0
#pragma once

// What a component says and sees when a deployment is checked, before anything runs.

#include <any>
#include <string>
#include <typeindex>
#include <vector>

#include "armature/component/component.hpp"
#include "armature/component/internal/inside.hpp"

namespace armature::component {

class EventBase;
class EventHandlerBase;
class InputPortBase;
class OperationBase;
class OperationCallerBase;
class OutputPortBase;
template <typename T>
class InputPort;
template <typename T>
class OutputPort;
template <typename Function>
class OperationCaller;
template <typename... Args>
class CommandCaller;
template <typename... Args>
class EventHandler;

/// Given to `Component::on_check` and to each `Checked` when names, peers, connections and periods
/// are known and properties have their values. Nothing is configured, nothing is connected: whoever
/// checks only looks.
/// @thread configuration only
class Check {
 public:
  /// The deployment is refused; the message gets the component's name and place.
  virtual void error(std::string message, std::string hint = {}) = 0;
  /// The deployment runs nevertheless.
  virtual void warning(std::string message, std::string hint = {}) = 0;

  /// The component drives what is not simulated, by `bus`: what is granted there is looked at
  /// twice.
  virtual void drives_hardware(std::string bus) = 0;

  /// All components of the deployment, as declared.
  virtual const std::vector<Component*>& components() const = 0;
  /// Those that the component has as peers, as declared.
  virtual std::vector<const Component*> peers() const = 0;
  /// Who writes an input, in any mode; of any component.
  virtual std::vector<const OutputPortBase*> writers_of(const InputPortBase& input) const = 0;
  /// Who reads an output, in any mode; of any component.
  virtual std::vector<const InputPortBase*> readers_of(const OutputPortBase& output) const = 0;
  /// Whether what one writes reaches the other a cycle later, as the deployment declares.
  virtual bool delayed(const OutputPortBase& writer, const InputPortBase& reader) const = 0;
  /// The operation that serves a caller; nullptr: none.
  virtual const OperationBase* target_of(const OperationCallerBase& caller) const = 0;
  /// The event that a handler handles; nullptr: none.
  virtual const EventBase* source_of(const EventHandlerBase& handler) const = 0;

  /// The same of the component's own members.
  template <typename T>
  auto writers_of(const InputPort<T>& input) const {
    return writers_of(internal::Inside::face(input));
  }
  template <typename T>
  auto readers_of(const OutputPort<T>& output) const {
    return readers_of(internal::Inside::face(output));
  }
  template <typename Function>
  auto target_of(const OperationCaller<Function>& caller) const {
    return target_of(internal::Inside::face(caller));
  }
  template <typename... Args>
  auto target_of(const CommandCaller<Args...>& caller) const {
    return target_of(internal::Inside::face(caller));
  }
  template <typename... Args>
  auto source_of(const EventHandler<Args...>& handler) const {
    return source_of(internal::Inside::face(handler));
  }

  /// Works out an answer once for all who ask while the deployment is checked: what is behind a
  /// port is asked by each component that leads there. Who asks the same while it is worked out, as
  /// in a wiring that goes round, is told an empty answer.
  /// @param about  with the type of the answer, what tells questions apart
  template <typename Answer, typename Work>
  const Answer& once(const void* about, const Work& work) const {
    std::any& known = answer(about, typeid(Answer));
    if (!known.has_value()) {
      known.emplace<Answer>();
      std::any_cast<Answer&>(known) = work();
    }
    return std::any_cast<const Answer&>(known);
  }

 protected:
  ~Check() = default;

 private:
  /// Empty until it is known; stays where it is.
  virtual std::any& answer(const void* about, std::type_index type) const = 0;
};

/// Part of a component that has something to check, whatever component it is part of.
class Checked {
 public:
  explicit Checked(Component* owner);
  Checked(const Checked&) = delete;
  Checked& operator=(const Checked&) = delete;

  virtual void check(Check& check) const = 0;

 protected:
  ~Checked() = default;
};

}  // namespace armature::component
