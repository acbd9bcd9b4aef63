// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include "armature/base/seconds.hpp"
#include "armature/runner/run_options.hpp"
#include "python/native/bindings.hpp"
#include "python/native/hook.hpp"
#include "python/native/simulation.hpp"
#include "python/native/values.hpp"

namespace armature::python {
namespace {

namespace py = pybind11;
using component::CommandHandle;
using component::CommandStage;

/// Of a text with a unit, or seconds.
base::Duration duration_of(py::handle value) {
  constexpr double kLongest = 1e9;  // [s]
  if (PyUnicode_Check(value.ptr())) {
    if (const auto duration = runner::parse_duration(value.cast<std::string>())) return *duration;
    throw py::value_error(
        "a duration is above 0 and has a unit of time, as '60 s' or '10 ms', found " +
        py::repr(value).cast<std::string>());
  }
  const double seconds = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() != nullptr) throw py::error_already_set();
  if (!(seconds >= 0.0 && seconds <= kLongest)) {
    throw py::value_error("a duration is a number of seconds from 0 to 1e9, found " +
                          py::repr(value).cast<std::string>());
  }
  return base::from_seconds(seconds);
}

void bind_command(py::module_& module) {
  py::class_<CommandHandle>(module, "CommandHandle")
      .def_property_readonly("ended", &CommandHandle::ended)
      .def_property_readonly("progress", &CommandHandle::progress)
      .def_property_readonly(
          "stage",
          [](const CommandHandle& self) { return std::string(component::name_of(self.stage())); })
      .def_property_readonly(
          "succeeded",
          [](const CommandHandle& self) { return self.stage() == CommandStage::kDone; })
      .def_property_readonly(
          "reason", [](const CommandHandle& self) { return text_to_python(self.reason()); })
      .def("cancel", [](CommandHandle& self) {
        expect_no_hook();
        return self.cancel();
      });
}

}  // namespace

void bind_simulation(py::module_& module) {
  bind_command(module);
  module.def(
      "seconds_of", [](py::handle value) { return base::to_seconds(duration_of(value)); },
      py::arg("duration"));
  py::class_<Simulation>(module, "Simulation")
      .def(py::init<std::shared_ptr<Deployed>, std::string, const std::vector<std::string>&>(),
           py::arg("deployed"), py::arg("record"), py::arg("grants"))
      .def("start", [](Simulation& self) { return self.start().all(); })
      .def(
          "stop", [](Simulation& self, bool in_order) { return self.stop(in_order).all(); },
          py::arg("in_order"))
      .def_property_readonly("running", &Simulation::running)
      .def_property_readonly("last_end", &Simulation::last_end)
      .def("faults",
           [](Simulation& self) {
             py::dict faults;
             for (const auto& fault : self.faults()) {
               faults[py::str(fault.component)] = text_to_python(fault.reason);
             }
             return faults;
           })
      .def_property_readonly(
          "now",
          [](const Simulation& self) { return base::to_seconds(base::Duration(self.now_ns())); })
      .def(
          "run_for",
          [](Simulation& self, py::handle duration, const py::object& condition) {
            return self.run_for(duration_of(duration), condition);
          },
          py::arg("duration"), py::arg("condition"))
      .def(
          "step", [](Simulation& self, py::handle at_most) { self.step(duration_of(at_most)); },
          py::arg("at_most"))
      .def("component_names", &Simulation::component_names)
      .def("describe", &Simulation::describe, py::arg("component"), py::arg("with_values"))
      .def("components", &Simulation::components)
      .def("log", &Simulation::log, py::arg("after"))
      .def("raised", &Simulation::raised, py::arg("component"), py::arg("event"))
      .def("change", &Simulation::change, py::arg("component"), py::arg("change"))
      .def(
          "read",
          [](Simulation& self, const std::string& component, const std::string& member) {
            const Reading reading = self.read(component, member);
            return py::make_tuple(reading.value, reading.age_s);
          },
          py::arg("component"), py::arg("member"))
      .def("write", &Simulation::write, py::arg("component"), py::arg("member"), py::arg("value"))
      .def("call", &Simulation::call, py::arg("component"), py::arg("operation"),
           py::arg("arguments"))
      .def("begin", &Simulation::begin, py::arg("component"), py::arg("command"),
           py::arg("arguments"));
}

}  // namespace armature::python
