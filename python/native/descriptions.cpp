// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <pybind11/stl.h>

#include "armature/base/seconds.hpp"
#include "armature/inspect/describe.hpp"
#include "armature/inspect/status.hpp"
#include "armature/inspect/view.hpp"
#include "python/native/bindings.hpp"
#include "python/native/values.hpp"

namespace armature::python {
namespace {

namespace py = pybind11;

void bind_status(py::module_& module) {
  using inspect::ComponentStatus;
  py::class_<ComponentStatus>(module, "ComponentStatus",
                              "Which component it is, and how it stands.")
      .def_readonly("name", &ComponentStatus::name)
      .def_readonly("model", &ComponentStatus::model)
      .def_property_readonly(
          "state",
          [](const ComponentStatus& self) {
            return self.state ? std::string(component::name_of(*self.state)) : std::string();
          },
          "`Running`, `Stopped`, ...; empty: whoever hosts it does not say")
      .def_property_readonly("reason", text_of<ComponentStatus>(&ComponentStatus::reason),
                             "why it does not run; may be empty")
      .def_readonly("thread", &ComponentStatus::thread);
}

void bind_members(py::module_& module) {
  using inspect::PropertyDescription;
  py::class_<PropertyDescription>(module, "PropertyDescription")
      .def_readonly("name", &PropertyDescription::name)
      .def_readonly("doc", &PropertyDescription::doc)
      .def_readonly("type", &PropertyDescription::type)
      .def_readonly("values", &PropertyDescription::values)
      .def_readonly("unit", &PropertyDescription::unit)
      .def_property_readonly("range",
                             [](const PropertyDescription& self) -> py::object {
                               if (!self.range) return py::none();
                               return py::make_tuple(self.range->low, self.range->high);
                             })
      .def_readonly("persistent", &PropertyDescription::persistent)
      .def_readonly("changeable_while_running", &PropertyDescription::changeable_while_running);

  using inspect::PortDescription;
  py::class_<PortDescription>(module, "PortDescription")
      .def_readonly("name", &PortDescription::name)
      .def_readonly("doc", &PortDescription::doc)
      .def_readonly("type", &PortDescription::type)
      .def_readonly("values", &PortDescription::values)
      .def_readonly("unit", &PortDescription::unit)
      .def_readonly("peers", &PortDescription::peers);
  py::class_<inspect::InputDescription, PortDescription>(module, "InputDescription");
  py::class_<inspect::OutputDescription, PortDescription>(module, "OutputDescription");

  using inspect::ArgumentDescription;
  py::class_<ArgumentDescription>(module, "ArgumentDescription")
      .def_readonly("name", &ArgumentDescription::name)
      .def_readonly("type", &ArgumentDescription::type);
  using inspect::OperationDescription;
  py::class_<OperationDescription>(module, "OperationDescription")
      .def_readonly("name", &OperationDescription::name)
      .def_readonly("doc", &OperationDescription::doc)
      .def_readonly("signature", &OperationDescription::signature)
      .def_readonly("arguments", &OperationDescription::arguments)
      .def_readonly("result", &OperationDescription::result)
      .def_readonly("command", &OperationDescription::command)
      .def_readonly("by_operator", &OperationDescription::by_operator);
  using inspect::EventDescription;
  py::class_<EventDescription>(module, "EventDescription")
      .def_readonly("name", &EventDescription::name)
      .def_readonly("doc", &EventDescription::doc)
      .def_readonly("signature", &EventDescription::signature)
      .def_readonly("raised", &EventDescription::raised);
  using inspect::FieldDescription;
  py::class_<FieldDescription>(module, "FieldDescription")
      .def_readonly("structure", &FieldDescription::structure)
      .def_readonly("name", &FieldDescription::name)
      .def_readonly("type", &FieldDescription::type)
      .def_readonly("unit", &FieldDescription::unit)
      .def_readonly("doc", &FieldDescription::doc);
}

void bind_component(py::module_& module) {
  using inspect::ComponentDescription;
  py::class_<ComponentDescription, inspect::ComponentStatus>(module, "ComponentDescription",
                                                             "A component's whole interface.")
      .def_readonly("activity", &ComponentDescription::activity)
      .def_readonly("properties", &ComponentDescription::properties)
      .def_readonly("inputs", &ComponentDescription::inputs)
      .def_readonly("outputs", &ComponentDescription::outputs)
      .def_readonly("operations", &ComponentDescription::operations)
      .def_readonly("events", &ComponentDescription::events)
      .def_readonly("fields", &ComponentDescription::fields);
}

void bind_log(py::module_& module) {
  using exec::LogLine;
  py::class_<LogLine>(module, "LogLine", "A line of an application's log.")
      .def_readonly("number", &LogLine::number, "the application's, from 1")
      .def_property_readonly(
          "time",
          [](const LogLine& self) { return base::to_seconds(self.time.time_since_epoch()); },
          "of the cycle in which it was written [s]")
      .def_property_readonly(
          "level", [](const LogLine& self) { return std::string(rt::name_of(self.level)); },
          "`debug`, `info`, `warning` or `error`")
      .def_readonly("component", &LogLine::component, "or thread, or `application`")
      .def_property_readonly("text", text_of<LogLine>(&LogLine::text), "what was said")
      .def("__str__",
           [](const LogLine& self) {
             return text_to_python(base::to_text(self.time.time_since_epoch()) + " " +
                                   std::string(rt::name_of(self.level)) + " " + self.component +
                                   ": " + self.text);
           })
      .def("__repr__", [](const LogLine& self) {
        return text_to_python("<LogLine " + std::to_string(self.number) + " " + self.component +
                              ": " + self.text + ">");
      });
}

}  // namespace

void bind_descriptions(py::module_& module) {
  bind_status(module);
  bind_members(module);
  bind_component(module);
  bind_log(module);
}

}  // namespace armature::python
