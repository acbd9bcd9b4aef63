// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/view.hpp"
#include "python/native/bindings.hpp"

namespace armature::python {

void bind_errors(pybind11::module_& module) {
  const pybind11::handle error = PyErr_NewException("armature.Error", PyExc_Exception, nullptr);
  module.add_object("Error", error);
  // The one that is registered last is tried first, and a refusal is a lack of an answer, too.
  pybind11::register_exception<inspect::NoAnswer>(module, "NoAnswer", error);
  pybind11::register_exception<inspect::Refusal>(module, "Refusal", error);
}

}  // namespace armature::python
