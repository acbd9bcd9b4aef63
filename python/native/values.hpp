// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "armature/types/type.hpp"

namespace armature::python {

/// What is not UTF-8 is replaced: the runtime cuts texts at bytes. Texts that the runtime writes
/// come to Python by this only, since pybind11's own conversion throws.
/// @thread one that holds the interpreter's lock, as for all functions here
pybind11::object text_to_python(std::string_view text);

/// A getter of a text, for `def_property_readonly`.
template <typename Owner, typename Holder>
auto text_of(std::string Holder::*member) {
  return [member](const Owner& self) { return text_to_python(self.*member); };
}

/// `str(value)`; what UTF-8 cannot say of it is escaped.
std::string text_from_python(pybind11::handle value);

/// A value as Python has it: numbers, `str` for texts and enumerations, `Struct` for structs, numpy
/// arrays for lists of what numpy knows, other lists as `list`. It is a copy.
pybind11::object to_python(const types::Type& type, const void* value);

/// The other way: an exception names the part, what was expected and what was found.
/// @param name  begins the message: `PID1.Kp`
types::Value from_python(pybind11::handle value, const types::Type& type, const std::string& name);

/// How numpy has values of the type, byte by byte; nothing for what has texts, enumerations or
/// lists that grow inside.
std::optional<pybind11::dtype> dtype_of(const types::Type& type);

}  // namespace armature::python
