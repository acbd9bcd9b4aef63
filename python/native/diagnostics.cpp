// SPDX-License-Identifier: Apache-2.0
#include "armature/base/diagnostic.hpp"
#include "python/native/bindings.hpp"
#include "python/native/values.hpp"

namespace armature::python {
namespace {

const char* severity_of(const base::Diagnostic& diagnostic) {
  switch (diagnostic.severity) {
    case base::Severity::kError:
      return "error";
    case base::Severity::kWarning:
      return "warning";
    case base::Severity::kNote:
      break;
  }
  return "note";
}

}  // namespace

void bind_diagnostics(pybind11::module_& module) {
  using base::Diagnostic;
  pybind11::class_<Diagnostic>(
      module, "Diagnostic", "One finding: where, what is wrong, what was expected, how to mend it.")
      .def_property_readonly("severity", &severity_of, "`error`, `warning` or `note`")
      .def_property_readonly("message", text_of<Diagnostic>(&Diagnostic::message), "what is wrong")
      .def_property_readonly("hint", text_of<Diagnostic>(&Diagnostic::hint),
                             "how to mend it; may be empty")
      .def_readonly("name", &Diagnostic::name, "of a warning that may be accepted; else empty")
      .def_property_readonly(
          "file", [](const Diagnostic& self) { return text_to_python(self.where.file); },
          "of the deployment, or one that it includes")
      .def_property_readonly(
          "line", [](const Diagnostic& self) { return self.where.line; },
          "counted from 1; 0: unknown")
      .def_property_readonly(
          "column", [](const Diagnostic& self) { return self.where.column; },
          "counted from 1; 0: unknown")
      .def("__str__", [](const Diagnostic& self) { return text_to_python(base::to_text(self)); })
      .def("__repr__", [](const Diagnostic& self) {
        return text_to_python("<Diagnostic " + base::to_text(self) + ">");
      });
}

}  // namespace armature::python
