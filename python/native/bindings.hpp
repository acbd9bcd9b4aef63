// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

// What the module `armature._native` consists of, each defined in the file of its name. The package
// `armature` in Python is what users see; this module gives it the runtime.
namespace armature::python {

void bind_errors(pybind11::module_& module);
void bind_error_metrics(pybind11::module_& module);
void bind_diagnostics(pybind11::module_& module);
void bind_descriptions(pybind11::module_& module);
void bind_deployment(pybind11::module_& module);
void bind_simulation(pybind11::module_& module);
void bind_recording(pybind11::module_& module);
void bind_components(pybind11::module_& module);
void bind_connection(pybind11::module_& module);

}  // namespace armature::python
