// SPDX-License-Identifier: Apache-2.0
#include "idl/internal/cpp_text.hpp"

#include <algorithm>
#include <charconv>

#include "idl/cpp_backend.hpp"
#include "idl/number.hpp"

namespace armature::idl {
namespace internal {
namespace {

std::string_view scalar(Basic basic) {
  switch (basic) {
    case Basic::kVoid:
      return "void";
    case Basic::kBool:
      return "bool";
    case Basic::kChar:
      return "std::int8_t";  // char is unsigned on some machines
    case Basic::kByte:
      return "std::uint8_t";
    case Basic::kShort:
      return "std::int16_t";
    case Basic::kUnsignedShort:
      return "std::uint16_t";
    case Basic::kInt:
      return "std::int32_t";
    case Basic::kUnsignedInt:
      return "std::uint32_t";
    case Basic::kLong:
      return "std::int64_t";
    case Basic::kUnsignedLong:
      return "std::uint64_t";
    case Basic::kFloat:
      return "float";
    case Basic::kDouble:
      return "double";
    case Basic::kString:
    case Basic::kStruct:
    case Basic::kEnum:
      break;
  }
  return "std::string";
}

bool by_value(const Type& type) {
  return !type.is_array() && type.basic != Basic::kString && type.basic != Basic::kStruct;
}

std::string whole_bound(const Whole& number) {
  // The digits of the least long alone are no literal.
  if (number == limits_of(Basic::kLong).least) return "-9223372036854775807 - 1";
  const bool large = limits_of(Basic::kLong).greatest < number;
  return to_text(number) + (large ? "u" : "");
}

template <typename T>
std::string real_bound(T value) {
  char digits[64];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  std::string text(digits, end);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

}  // namespace

bool is_flags(const Type& type) {
  return type.basic == Basic::kBool && type.form == Type::Form::kCounted;
}

CppText::CppText(const Program& program, const CppNames& names) : program_(program), names_(names) {
  // Nested structs may be defined in any order: until nothing is new, at most as deep as they nest.
  std::size_t before = 1;
  while (before != with_range_.size()) {
    before = with_range_.size();
    for (const Module& module : program.modules()) {
      for (const Structure& structure : module.structures) {
        for (const Field& member : structure.members) {
          if (member.range || has_range(member.type)) with_range_.insert(&structure);
        }
      }
    }
    if (with_range_.empty()) return;
  }
}

bool CppText::has_range(const Type& type) const {
  return type.basic == Basic::kStruct && has_range(*program_.find_struct(type.name));
}

std::string CppText::single(const Type& type) const {
  if (type.basic == Basic::kStruct) {
    return qualified(type.name, program_.find_struct(type.name)->module);
  }
  if (type.basic == Basic::kEnum) {
    return qualified(type.name, program_.find_enum(type.name)->module);
  }
  return std::string(scalar(type.basic));
}

std::string CppText::event_type(const std::string& event) const {
  return qualified(event, program_.find_event(event)->module);
}

std::string CppText::qualified(const std::string& name, const std::string& module) const {
  const std::string theirs = names_.name_space(module);
  const std::string ours = names_.name_space(main());
  return (theirs == ours ? "" : theirs + "::") + names_.type(name);
}

std::string CppText::documentation(const Operation& operation) const {
  std::vector<std::string> lines = operation.doc;
  const Items names = parameter_names(operation);
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string all;
    for (const std::string& line : described(operation.parameters[i])) {
      all += (all.empty() ? "" : " ") + line;
    }
    if (!all.empty()) lines.push_back("@param " + names[i] + "  " + all);
  }
  return comment(2, lines);
}

std::string CppText::type(const Type& type) const {
  if (is_flags(type)) return "std::vector<std::uint8_t>";
  if (type.form == Type::Form::kCounted) return "std::vector<" + single(type) + ">";
  if (type.form == Type::Form::kSingle) return single(type);
  return "std::array<" + single(type) + ", " + std::to_string(type.count) + ">";
}

std::string CppText::variable_type(const Type& type) const {
  return is_flags(type) ? "armature::ride::Flags" : this->type(type);
}

std::string CppText::parameter_type(const Type& type) const {
  return by_value(type) ? this->type(type) : "const " + variable_type(type) + "&";
}

Items CppText::parameters(const Operation& operation) const {
  Items items = parameter_names(operation);
  for (std::size_t i = 0; i < items.size(); ++i) {
    items[i] = parameter_type(operation.parameters[i].type) + " " + items[i];
  }
  return items;
}

Items CppText::parameter_names(const Operation& operation) const {
  return names_.parameters(operation.parameters);
}

std::string CppText::bound(const std::string& text, Basic type) const {
  if (is_whole_number(type)) return whole_bound(parse_whole(text).value_or(Whole{}));
  const double value = parse_real(text).value_or(0.0);
  if (type == Basic::kDouble) return real_bound(value);
  return real_bound(static_cast<float>(value)) + "f";
}

Items CppText::bounds(const Range& range, Basic type) const {
  return {bound(range.low, type), bound(range.high, type)};
}

std::string CppText::underlying(const Enumeration& enumeration) {
  return std::string(scalar(enumeration.underlying));
}

std::string CppText::value(const Enumerator& enumerator) { return whole_bound(enumerator.value); }

std::string CppText::initial(const Type& type) const {
  if (type.form == Type::Form::kFixed) return " = {}";
  if (type.is_array() || type.basic == Basic::kString || type.basic == Basic::kStruct) return "";
  if (type.basic == Basic::kEnum) {
    const Enumerator& first = program_.find_enum(type.name)->first_value();
    return " = " + single(type) + "::" + names_.enumerator(first.name);
  }
  if (type.basic == Basic::kBool) return " = false";
  if (type.basic == Basic::kFloat) return " = 0.0f";
  return type.basic == Basic::kDouble ? " = 0.0" : " = 0";
}

std::string CppText::range_text(const Range& range) { return range.low + " to " + range.high; }

std::vector<std::string> CppText::described(const Field& field) {
  std::vector<std::string> lines = field.doc;
  std::string behind;
  if (!field.unit.empty()) behind = "[" + field.unit + "]";
  if (field.range) behind += (behind.empty() ? "" : ", ") + range_text(*field.range);
  if (behind.empty()) return lines;
  if (lines.empty()) return {behind};
  lines.front() += (lines.front().empty() ? "" : " ") + behind;
  return lines;
}

std::string CppText::include_flags() const {
  const auto uses_flags = [](const Operation& operation) {
    return is_flags(operation.result) ||
           std::any_of(operation.parameters.begin(), operation.parameters.end(),
                       [](const Field& parameter) { return is_flags(parameter.type); });
  };
  for (const Interface& interface : main().interfaces) {
    if (std::any_of(interface.operations.begin(), interface.operations.end(), uses_flags)) {
      return "#include \"armature/ride/flags.hpp\"\n";
    }
  }
  return {};
}

std::string CppText::head(bool header) const {
  const std::string text =
      "// Generated by rcidl from " + main().name + ".idl: changes here are lost.\n";
  return header ? text + "#pragma once\n\n" : text;
}

std::string CppText::begin_name_space() const {
  return "namespace " + names_.name_space(main()) + " {\n";
}

std::string CppText::end_name_space() const {
  return "\n}  // namespace " + names_.name_space(main()) + "\n";
}

}  // namespace internal

std::vector<OutputFile> write_cpp(const Program& program, const CppNames& names) {
  const internal::CppText text(program, names);
  const std::string& name = program.main().name;
  if (program.main().interfaces.empty()) {
    const std::string nothing = "// There is no interface in it.\n";
    return {{name + "_types.hpp", write_types(text)},
            {name + "_client.hpp", text.head(true) + nothing},
            {name + "_client.cpp", text.head(false) + nothing},
            {name + "_service.hpp", text.head(true) + nothing},
            {name + "_service.cpp", text.head(false) + nothing}};
  }
  return {{name + "_types.hpp", write_types(text)},
          {name + "_client.hpp", write_client_header(text)},
          {name + "_client.cpp", write_client_source(text)},
          {name + "_service.hpp", write_service_header(text)},
          {name + "_service.cpp", write_service_source(text)}};
}

}  // namespace armature::idl
