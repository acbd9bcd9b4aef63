// SPDX-License-Identifier: Apache-2.0
// Ports, properties, operations, events and commands of the usual types, compiled once.

#include <string>
#include <vector>

#include "armature/component/events/event.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/component/operations/operation.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"
#include "armature/component/ports/port_array.hpp"
#include "armature/component/properties/property.hpp"

namespace armature::component {

template class Property<bool>;
template class Property<int>;
template class Property<double>;
template class Property<std::string>;
template class Property<std::vector<double>>;
template class Attribute<bool>;
template class Attribute<int>;
template class Attribute<double>;
template class InputPort<bool>;
template class InputPort<int>;
template class InputPort<double>;
template class InputPort<std::vector<double>>;
template class OutputPort<bool>;
template class OutputPort<int>;
template class OutputPort<double>;
template class OutputPort<std::vector<double>>;
template class PortArray<InputPort<double>>;
template class PortArray<OutputPort<double>>;
template class Operation<void()>;
template class Operation<bool()>;
template class Operation<double()>;
template class Operation<void(double)>;
template class OperationCaller<void()>;
template class OperationCaller<bool()>;
template class OperationCaller<double()>;
template class OperationCaller<void(double)>;
template class Event<>;
template class EventHandler<>;
template class Command<>;
template class Command<double>;
template class Command<const std::vector<double>&>;
template class CommandCaller<>;
template class CommandCaller<double>;
template class CommandCaller<const std::vector<double>&>;

}  // namespace armature::component
