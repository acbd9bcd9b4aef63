// SPDX-License-Identifier: Apache-2.0
#include <exception>
#include <string>

#include "armature/inspect/view.hpp"
#include "python/native/bindings.hpp"
#include "python/native/values.hpp"

namespace armature::python {
namespace {

namespace py = pybind11;

PyObject* add_error(py::module_& module, const char* name, const char* doc, PyObject* base) {
  PyObject* const made =
      PyErr_NewExceptionWithDoc(("armature." + std::string(name)).c_str(), doc, base, nullptr);
  if (made == nullptr) throw py::error_already_set();
  module.add_object(name, made);
  return made;
}

// They live as long as the process, as its translators do.
PyObject* no_answer_class = nullptr;
PyObject* refusal_class = nullptr;

/// pybind11's own translation throws where a text is not UTF-8.
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const inspect::Refusal& error) {
    PyErr_SetObject(refusal_class, text_to_python(error.what()).ptr());
  } catch (const inspect::NoAnswer& error) {
    PyErr_SetObject(no_answer_class, text_to_python(error.what()).ptr());
  }
}

}  // namespace

void bind_errors(py::module_& module) {
  PyObject* const error = add_error(
      module, "Error", "What an application refuses, cannot answer, or does not do in good order.",
      PyExc_Exception);
  no_answer_class = add_error(module, "NoAnswer", "Nobody answers, or not to this.", error);
  refusal_class = add_error(
      module, "Refusal",
      "The application refuses, or knows no such thing; the text says what to do.", error);
  py::register_exception_translator(&translate);
}

}  // namespace armature::python
