// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/view.hpp"
#include "python/native/bindings.hpp"

namespace armature::python {

void bind_errors(pybind11::module_& module) {
  const pybind11::handle error = PyErr_NewExceptionWithDoc(
      "armature.Error", "What an application refuses, cannot answer, or does not do in good order.",
      PyExc_Exception, nullptr);
  module.add_object("Error", error);
  // The one that is registered last is tried first, and a refusal is a lack of an answer, too.
  pybind11::register_exception<inspect::NoAnswer>(module, "NoAnswer", error).doc() =
      "Nobody answers, or not to this.";
  pybind11::register_exception<inspect::Refusal>(module, "Refusal", error).doc() =
      "The application refuses, or knows no such thing; the text says what to do.";
}

}  // namespace armature::python
