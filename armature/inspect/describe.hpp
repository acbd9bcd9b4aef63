// SPDX-License-Identifier: Apache-2.0
#pragma once

// What tools show of a component: plain structs with text, which outlive it. Of a component of
// another process everything is known but what is marked "(here)".

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/component.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"
#include "armature/component/properties/property.hpp"
#include "armature/inspect/status.hpp"

namespace armature::inspect {

/// A property or attribute, as tools show it.
struct PropertyDescription {
  std::string name;
  std::string doc;
  std::string type;
  std::vector<std::string> values;  ///< of an enumeration: their names (here; else in the doc)
  std::string unit;
  std::string unit_property;  ///< its name, where one names the unit (here)
  std::optional<component::Range> range;
  bool persistent = true;  ///< false: an attribute
  bool changeable_while_running = false;
  bool mandatory = false;
  bool by_operator = false;
  bool was_set = false;  ///< (here)
  std::string value;     ///< only if asked for

  bool operator==(const PropertyDescription&) const = default;
};

/// What input and output ports have in common, as tools show it.
struct PortDescription {
  std::string name;
  std::string doc;
  std::string type;
  std::vector<std::string> values;  ///< of an enumeration: their names (here; else in the doc)
  std::string unit;
  std::string unit_property;        ///< its name, where one names the unit (here)
  std::optional<std::size_t> size;  ///< declared number of elements of a vector
  std::vector<std::string> peers;   ///< `component.port` at the other end of each connection
  std::string value;                ///< only if asked for and written
  bool written = false;
  base::Duration age{};        ///< of a written value, in an application
  std::uint64_t sequence = 0;  ///< how many values were written (here)

  bool connected() const { return !peers.empty(); }
  bool operator==(const PortDescription&) const = default;
};

/// An input port, as tools show it.
struct InputDescription : PortDescription {
  bool triggers = false;
  bool may_stay_open = false;  ///< (here)
  bool allows_fan_in = false;  ///< (here)
  base::Duration max_age{};    ///< 0: data does not age
  component::Reaction when_stale = component::Reaction::kStop;
  component::Reaction when_lost = component::Reaction::kStop;  ///< (here)
  component::InputCounters counters;                           ///< (here)

  bool operator==(const InputDescription&) const = default;
};

/// An output port, as tools show it.
struct OutputDescription : PortDescription {
  component::OutputCounters counters;  ///< (here)

  bool operator==(const OutputDescription&) const = default;
};

/// An array of ports whose number a property says (here).
struct PortArrayDescription {
  std::string name;
  std::string count;  ///< the property that says how many ports `name1..nameN` there are

  bool operator==(const PortArrayDescription&) const = default;
};

/// An argument of an operation or an event.
struct ArgumentDescription {
  std::string name;  ///< may be empty; with its unit: `target [m]`
  std::string type;

  bool operator==(const ArgumentDescription&) const = default;
};

/// An operation or a command, as tools show it.
struct OperationDescription {
  std::string name;
  std::string doc;
  std::string signature;  ///< `double(double position [rad])`
  std::vector<ArgumentDescription> arguments;
  std::string result;       ///< its type; empty if there is none
  bool own_thread = false;  ///< (here)
  bool command = false;     ///< goes on after it was accepted
  bool by_operator = false;

  bool operator==(const OperationDescription&) const = default;
};

/// An event, as tools show it.
struct EventDescription {
  std::string name;
  std::string doc;
  std::string signature;
  std::vector<ArgumentDescription> arguments;  ///< (here)
  std::uint64_t raised = 0;                    ///< (here)
  std::vector<std::string> subscribers;        ///< names of components

  bool operator==(const EventDescription&) const = default;
};

/// An operation that is called, or an event that is handled.
struct RequirementDescription {
  std::string name;
  std::string doc;
  std::string signature;
  bool event = false;
  bool command = false;
  bool optional = false;
  bool wanted = true;           ///< false: a property says that it is not needed (here)
  std::string peer;             ///< that a property demands; empty: any (here)
  std::string bound_to;         ///< `component.operation`; empty: not bound
  std::uint64_t not_taken = 0;  ///< calls or events that met a full queue (here)

  bool operator==(const RequirementDescription&) const = default;
};

/// A state machine, as tools show it.
struct MachineDescription {
  /// A state; `path` names those around it.
  struct State {
    std::string path;
    std::string doc;     ///< (here)
    bool final = false;  ///< (here)

    bool operator==(const State&) const = default;
  };
  std::string name;
  std::string doc;
  std::vector<State> states;
  std::vector<std::string> transitions;  ///< `Idle -> Moving on drive [is_free] / note` (here)
  std::vector<std::string> triggers;     ///< (here)
  std::vector<std::string> problems;     ///< (here)
  std::string current;  ///< path of the active states; empty while the component does not run

  bool operator==(const MachineDescription&) const = default;
};

/// A member of a struct that is the type of one of a component's values.
struct FieldDescription {
  std::string structure;  ///< the type's name
  std::string name;
  std::string type;
  std::string unit;
  std::string doc;
  std::vector<std::string> values;  ///< of an enumeration: their names (here; else in the doc)

  bool operator==(const FieldDescription&) const = default;
};

/// A component: its whole interface, and how it stands now.
struct ComponentDescription : ComponentStatus {
  std::string activity;   ///< of its thread; empty outside of an application
  bool answered = false;  ///< what changes as it works is known; else there are no values
  std::vector<PropertyDescription> properties;
  std::vector<InputDescription> inputs;
  std::vector<OutputDescription> outputs;
  std::vector<PortArrayDescription> port_arrays;
  std::vector<OperationDescription> operations;
  std::vector<EventDescription> events;
  std::vector<RequirementDescription> requirements;
  std::vector<MachineDescription> machines;
  std::vector<FieldDescription> fields;
  std::size_t most_calls = 0;  ///< that its deployment may give it under `calls` (here)

  bool operator==(const ComponentDescription&) const = default;
};

/// `doc` with the names of the values of an enumeration, if there are any.
std::string doc_with_values(const std::string& doc, const std::vector<std::string>& values);

/// Whether the values of properties and ports become text as well.
enum class Values : std::uint8_t { kLeftOut, kIncluded };

/// Everything there is to know about `component`; allocates.
/// @param model  the name under which it was made
/// @thread the component's own, or any while the component does not run
ComponentDescription describe(const component::Component& component, std::string model,
                              Values values = Values::kIncluded);

}  // namespace armature::inspect
