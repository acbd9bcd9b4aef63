// SPDX-License-Identifier: Apache-2.0
#pragma once

// What tools show of a component: plain structs with text, which outlive it.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/component.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"

namespace armature::inspect {

/// A property or attribute, as tools show it.
struct PropertyDescription {
  std::string name;
  std::string doc;
  std::string type;
  std::vector<std::string> values;  ///< of an enumeration: their names
  std::string unit;
  std::optional<component::Range> range;
  bool persistent = true;  ///< false: an attribute
  bool changeable_while_running = false;
  bool mandatory = false;
  bool was_set = false;
  std::string value;  ///< only if asked for
};

/// What input and output ports have in common, as tools show it.
struct PortDescription {
  std::string name;
  std::string doc;
  std::string type;
  std::vector<std::string> values;  ///< of an enumeration: their names
  std::string unit;
  std::optional<std::size_t> size;  ///< declared number of elements of a vector
  std::vector<std::string> peers;   ///< `component.port` at the other end of each connection
  std::string value;                ///< only if asked for
  std::uint64_t sequence = 0;       ///< how many values were written; 0: none yet

  bool connected() const { return !peers.empty(); }
};

/// An input port, as tools show it.
struct InputDescription : PortDescription {
  bool triggers = false;
  bool may_stay_open = false;
  bool allows_fan_in = false;
  base::Duration max_age{};  ///< 0: data does not age
  component::Reaction when_stale = component::Reaction::kStop;
  component::Reaction when_lost = component::Reaction::kStop;
  component::InputCounters counters;
};

/// An output port, as tools show it.
struct OutputDescription : PortDescription {
  component::OutputCounters counters;
};

/// An array of ports whose number a property says.
struct PortArrayDescription {
  std::string name;
  std::string count;  ///< the property that says how many ports `name1..nameN` there are
};

/// An operation or a command, as tools show it.
struct OperationDescription {
  std::string name;
  std::string doc;
  std::string signature;  ///< `double(double position [rad])`
  bool own_thread = false;
  bool command = false;  ///< goes on after it was accepted
  bool by_operator = false;
};

/// An event, as tools show it.
struct EventDescription {
  std::string name;
  std::string doc;
  std::string signature;
  std::uint64_t raised = 0;
  std::vector<std::string> subscribers;  ///< names of components
};

/// An operation that is called, or an event that is handled.
struct RequirementDescription {
  std::string name;
  std::string doc;
  std::string signature;
  bool event = false;
  bool command = false;
  bool optional = false;
  bool wanted = true;           ///< false: a property says that it is not needed
  std::string peer;             ///< that a property demands; empty: any
  std::string bound_to;         ///< `component.operation`; empty: not bound
  std::uint64_t not_taken = 0;  ///< calls or events that met a full queue
};

/// A state machine, as tools show it.
struct MachineDescription {
  /// A state; `path` names those around it.
  struct State {
    std::string path;
    std::string doc;
    bool final = false;
  };
  std::string name;
  std::string doc;
  std::vector<State> states;
  std::vector<std::string> transitions;  ///< `Idle -> Moving on drive [is_free] / note`
  std::vector<std::string> triggers;
  std::vector<std::string> problems;
  std::string current;  ///< path of the active states; empty while the component does not run
};

/// A component: its whole interface, and how it stands now.
struct ComponentDescription {
  std::string model;
  std::string name;
  component::State state = component::State::kPreOperational;
  std::string reason;
  std::vector<PropertyDescription> properties;
  std::vector<InputDescription> inputs;
  std::vector<OutputDescription> outputs;
  std::vector<PortArrayDescription> port_arrays;
  std::vector<OperationDescription> operations;
  std::vector<EventDescription> events;
  std::vector<RequirementDescription> requirements;
  std::vector<MachineDescription> machines;
};

/// Whether the values of properties and ports become text as well.
enum class Values : std::uint8_t { kLeftOut, kIncluded };

/// Everything there is to know about `component`; allocates.
/// @param model  the name under which it was made
/// @thread the component's own, or any while the component does not run
ComponentDescription describe(const component::Component& component, std::string model,
                              Values values = Values::kIncluded);

}  // namespace armature::inspect
