// SPDX-License-Identifier: Apache-2.0
#include "python/native/values.hpp"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/types/elements.hpp"
#include "armature/types/enum.hpp"

namespace armature::python {
namespace {

namespace py = pybind11;
using types::Kind;
using types::Type;

py::object scalar_to_python(const Type& type, const void* value) {
  return types::with_scalar(type.kind, [&]<typename T>(std::type_identity<T>) -> py::object {
    T scalar{};
    std::memcpy(&scalar, value, sizeof scalar);
    if constexpr (std::is_same_v<T, bool>) {
      return py::bool_(scalar);
    } else if constexpr (std::is_floating_point_v<T>) {
      return py::float_(static_cast<double>(scalar));
    } else {
      return py::int_(scalar);
    }
  });
}

py::object list_to_python(const Type& type, const void* value) {
  const std::size_t count = types::element_count(type, value);
  const std::byte* const first = types::elements(type, value);
  if (const auto dtype = dtype_of(*type.element)) {
    const py::array made(*dtype, std::vector<py::ssize_t>{static_cast<py::ssize_t>(count)});
    if (count > 0) std::memcpy(const_cast<void*>(made.data()), first, count * type.element->size);
    return made;
  }
  py::list made;
  for (std::size_t i = 0; i < count; ++i) {
    made.append(to_python(*type.element, first + i * type.element->size));
  }
  return made;
}

py::object struct_to_python(const Type& type, const void* value) {
  py::dict fields;
  for (const types::Field& field : type.fields) {
    fields[text_to_python(field.name)] =
        to_python(*field.type, types::at_offset(value, field.offset));
  }
  return py::module_::import("armature._values").attr("Struct")(fields);
}

std::optional<py::dtype> scalar_dtype(const Type& type) {
  return types::with_scalar(type.kind,
                            []<typename T>(std::type_identity<T>) -> std::optional<py::dtype> {
                              return py::dtype::of<T>();
                            });
}

/// Fills values of described types; what is wrong is an exception that begins with the part's name.
class Reader {
 public:
  static void read(py::handle from, const Type& type, void* to, const std::string& name);

 private:
  [[noreturn]] static void refuse(const std::string& name, const std::string& expected,
                                  py::handle found) {
    throw py::value_error(name + " must be " + expected + ", found " +
                          text_from_python(py::repr(found)));
  }
  template <typename T>
  static void read_scalar(py::handle from, const Type& type, void* to, const std::string& name);
  static void read_text(py::handle from, const Type& type, void* to, const std::string& name);
  static void read_enumerator(py::handle from, const Type& type, void* to, const std::string& name);
  static void read_list(py::handle from, const Type& type, void* to, const std::string& name);
  static void read_struct(py::handle from, const Type& type, void* to, const std::string& name);
};

bool is_bool(py::handle value) {
  return PyBool_Check(value.ptr()) ||
         py::isinstance(value, py::module_::import("numpy").attr("bool_"));
}

bool is_of_numpy(py::handle value) { return py::isinstance<py::array>(value); }

/// [n] or more; a scalar of numpy may be an array, too.
bool has_elements(py::handle value) {
  return is_of_numpy(value) && py::reinterpret_borrow<py::array>(value).ndim() > 0;
}

/// What has elements that are values: a text and bytes have letters, a dict has keys.
bool is_sequence(py::handle value) {
  if (is_of_numpy(value)) return has_elements(value);
  PyObject* const one = value.ptr();
  return PySequence_Check(one) != 0 && !PyUnicode_Check(one) && !PyDict_Check(one) &&
         !PyBytes_Check(one) && !PyByteArray_Check(one);
}

/// A float, an int, or what numpy has for them.
std::optional<double> float_of(py::handle value) {
  if (PyFloat_CheckExact(value.ptr())) return PyFloat_AS_DOUBLE(value.ptr());
  if (is_bool(value) || PyUnicode_Check(value.ptr())) return std::nullopt;
  if (has_elements(value)) return std::nullopt;  // one of one element is a number for numpy
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() == nullptr) return number;
  PyErr_Clear();
  return std::nullopt;
}

/// Nothing if it is no whole number, or in no range of 64 bits.
template <typename T>
std::optional<T> whole_of(py::handle value, bool& is_whole) {
  is_whole = PyIndex_Check(value.ptr()) != 0 && !is_bool(value);
  if (!is_whole) return std::nullopt;
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!index) throw py::error_already_set();
  using Wide = std::conditional_t<std::is_signed_v<T>, long long, unsigned long long>;
  Wide wide{};
  if constexpr (std::is_signed_v<T>) {
    wide = PyLong_AsLongLong(index.ptr());
  } else {
    wide = PyLong_AsUnsignedLongLong(index.ptr());
  }
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    return std::nullopt;
  }
  return std::in_range<T>(wide) ? std::optional(static_cast<T>(wide)) : std::nullopt;
}

template <typename T>
void Reader::read_scalar(py::handle from, const Type& type, void* to, const std::string& name) {
  T value{};
  if constexpr (std::is_same_v<T, bool>) {
    if (!is_bool(from)) refuse(name, "True or False", from);
    value = py::bool_(py::reinterpret_borrow<py::object>(from));
  } else if constexpr (std::is_floating_point_v<T>) {
    const auto number = float_of(from);
    if (!number) refuse(name, "a number", from);
    value = static_cast<T>(*number);
  } else {
    bool is_whole = false;
    const auto number = whole_of<T>(from, is_whole);
    if (!is_whole) refuse(name, "a whole number", from);
    if (!number) refuse(name, "in the range of " + type.name, from);
    value = *number;
  }
  std::memcpy(to, &value, sizeof value);
}

void Reader::read_text(py::handle from, const Type& type, void* to, const std::string& name) {
  if (!PyUnicode_Check(from.ptr())) refuse(name, "a text", from);
  if (PyUnicode_AsUTF8(from.ptr()) == nullptr) {
    PyErr_Clear();
    refuse(name, "a text that UTF-8 can say", from);
  }
  const auto text = from.cast<std::string>();
  if (type.kind == Kind::kFixedText && text.size() > type.count) {
    throw py::value_error(name + " must have at most " + std::to_string(type.count) +
                          " bytes, found " + std::to_string(text.size()));
  }
  type.set_text(to, text);
}

void Reader::read_enumerator(py::handle from, const Type& type, void* to, const std::string& name) {
  if (!PyUnicode_Check(from.ptr())) refuse(name, types::enumerator_list(type), from);
  const std::string text = text_from_python(from);
  const types::Enumerator* const found = types::find_enumerator(type, text);
  if (found == nullptr) {
    const std::string hint = types::near_enumerator(type, text);
    refuse(name, types::enumerator_list(type) + (hint.empty() ? "" : " (" + hint + ")"), from);
  }
  types::set_enumerator(type, *found, to);
}

void Reader::read_list(py::handle from, const Type& type, void* to, const std::string& name) {
  const bool is_array = type.kind == Kind::kArray;
  const std::string expected =
      is_array ? "a sequence of " + std::to_string(type.count) + " elements" : "a sequence";
  if (!is_sequence(from)) refuse(name, expected, from);
  const auto sequence = py::reinterpret_borrow<py::sequence>(from);
  const std::size_t count = sequence.size();
  if (is_array && count != type.count) refuse(name, expected, from);
  if (!is_array) type.vector_resize(to, count);
  std::byte* const first = types::elements(type, to);
  for (std::size_t i = 0; i < count; ++i) {
    read(sequence[i], *type.element, first + i * type.element->size,
         name + "[" + std::to_string(i) + "]");
  }
}

void Reader::read_struct(py::handle from, const Type& type, void* to, const std::string& name) {
  if (!PyDict_Check(from.ptr())) refuse(name, "a dict with the fields of " + type.name, from);
  const auto given = py::reinterpret_borrow<py::dict>(from);
  std::vector<std::string> known;
  for (const types::Field& field : type.fields) known.emplace_back(field.name);
  for (const auto& [key, value] : given) {
    const std::string text = text_from_python(key);
    if (std::ranges::find(known, text) != known.end()) continue;
    throw py::value_error(name + " has no field '" + text + "'" +
                          base::suggestion_in_brackets(text, known));
  }
  for (const types::Field& field : type.fields) {
    const py::object key = text_to_python(field.name);
    const std::string part = name + "." + std::string(field.name);
    if (!given.contains(key)) throw py::value_error(part + " is missing");
    read(given[key], *field.type, types::at_offset(to, field.offset), part);
  }
}

void Reader::read(py::handle from, const Type& type, void* to, const std::string& name) {
  if (type.sealed) {
    throw py::value_error(name + " must be a " + type.name + ", which only components make");
  }
  if (types::is_text(type)) return read_text(from, type, to, name);
  if (types::is_list(type)) return read_list(from, type, to, name);
  if (type.kind == Kind::kStruct) return read_struct(from, type, to, name);
  if (type.kind == Kind::kEnum) return read_enumerator(from, type, to, name);
  types::with_scalar(type.kind, [&]<typename T>(std::type_identity<T>) {
    read_scalar<T>(from, type, to, name);
    return true;
  });
}

}  // namespace

py::object text_to_python(std::string_view text) {
  PyObject* const made =
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace");
  if (made == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::object>(made);
}

std::string text_from_python(py::handle value) {
  const py::str text(value);
  const auto bytes = py::reinterpret_steal<py::bytes>(
      PyUnicode_AsEncodedString(text.ptr(), "utf-8", "backslashreplace"));
  if (!bytes) throw py::error_already_set();
  return bytes;
}

std::optional<py::dtype> dtype_of(const Type& type) {
  if (types::is_number(type) || type.kind == Kind::kBool) return scalar_dtype(type);
  if (type.kind == Kind::kArray) {
    const auto element = dtype_of(*type.element);
    if (!element) return std::nullopt;
    return py::dtype::from_args(py::make_tuple(*element, py::make_tuple(type.count)));
  }
  if (type.kind != Kind::kStruct) return std::nullopt;
  py::list names;
  py::list formats;
  py::list offsets;
  for (const types::Field& field : type.fields) {
    const auto format = dtype_of(*field.type);
    if (!format) return std::nullopt;
    names.append(text_to_python(field.name));
    formats.append(*format);
    offsets.append(field.offset);
  }
  return py::dtype(names, formats, offsets, static_cast<py::ssize_t>(type.size));
}

py::object to_python(const Type& type, const void* value) {
  if (types::is_text(type)) return text_to_python(type.text(value));
  if (types::is_list(type)) return list_to_python(type, value);
  if (type.kind == Kind::kStruct) return struct_to_python(type, value);
  if (type.kind == Kind::kEnum) return text_to_python(types::to_text(type, value));
  return scalar_to_python(type, value);
}

types::Value from_python(py::handle value, const Type& type, const std::string& name) {
  types::Value made(type);
  Reader::read(value, type, made.data(), name);
  return made;
}

}  // namespace armature::python
