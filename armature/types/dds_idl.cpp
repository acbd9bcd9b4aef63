// SPDX-License-Identifier: Apache-2.0
#include "armature/types/dds_idl.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

namespace armature::types {
namespace {

constexpr std::string_view kModule = "armature::msg::dds_::";

/// As a part of a name: `Float64`, `PoseVector`, `Float32Array3`, `Text63`.
std::string word_of(const Type& type) {
  switch (type.kind) {
    case Kind::kBool:
      return "Bool";
    case Kind::kInt8:
      return "Int8";
    case Kind::kUint8:
      return "Uint8";
    case Kind::kInt16:
      return "Int16";
    case Kind::kUint16:
      return "Uint16";
    case Kind::kInt32:
      return "Int32";
    case Kind::kUint32:
      return "Uint32";
    case Kind::kInt64:
      return "Int64";
    case Kind::kUint64:
      return "Uint64";
    case Kind::kFloat:
      return "Float32";
    case Kind::kDouble:
      return "Float64";
    case Kind::kFixedText:
      return "Text" + std::to_string(type.count);
    case Kind::kArray:
      return word_of(*type.element) + "Array" + std::to_string(type.count);
    case Kind::kVector:
      return word_of(*type.element) + "Vector";
    default:
      break;
  }
  std::string word = type.name;
  std::ranges::replace_if(
      word, [](unsigned char each) { return std::isalnum(each) == 0; }, '_');
  return word;
}

/// The type of a member, without the bounds of arrays.
std::string declared(const Type& type) {
  switch (type.kind) {
    case Kind::kBool:
      return "boolean";
    case Kind::kInt8:
      return "int8";
    case Kind::kUint8:
      return "uint8";
    case Kind::kInt16:
      return "int16";
    case Kind::kUint16:
      return "uint16";
    case Kind::kInt32:
      return "int32";
    case Kind::kUint32:
      return "uint32";
    case Kind::kInt64:
      return "int64";
    case Kind::kUint64:
      return "uint64";
    case Kind::kFloat:
      return "float";
    case Kind::kDouble:
      return "double";
    case Kind::kEnum:
      return declared(*type.underlying);
    case Kind::kFixedText:
      return "string<" + std::to_string(type.count) + ">";
    case Kind::kArray:
      return declared(*type.element);
    case Kind::kVector:
      return "sequence<" + declared(*type.element) + " >";
    default:
      return std::string(kModule) + word_of(type) + "_";
  }
}

std::string member(const Type& type, std::string_view name) {
  std::string text = declared(type) + " " + std::string(name);
  for (const Type* each = &type; each->kind == Kind::kArray; each = each->element) {
    text += "[" + std::to_string(each->count) + "]";
  }
  return text + ";";
}

std::string remark(const Type& type, std::string_view unit) {
  const Type* inner = &type;
  while (inner->element != nullptr) inner = inner->element;
  std::string text(unit);
  for (const Enumerator& each : inner->enumerators) {
    text += (text.empty() ? "" : ", ") + each.name + " = " + std::to_string(each.value);
  }
  return text.empty() ? text : "  // " + text;
}

/// The structs inside a type, inner ones first, each once.
void gather(const Type& type, std::vector<const Type*>& structs) {
  if (type.element != nullptr) return gather(*type.element, structs);
  if (type.kind != Kind::kStruct) return;
  for (const Field& field : type.fields) gather(*field.type, structs);
  const bool known =
      std::ranges::any_of(structs, [&](const Type* each) { return each->name == type.name; });
  if (!known) structs.push_back(&type);
}

}  // namespace

std::string dds_name(const Type& type) { return std::string(kModule) + word_of(type) + "_"; }

std::string dds_objection(const Type& type) {
  if (type.sealed) return "'" + type.name + "' is made by its own class only";
  if (type.kind == Kind::kText) return "a text that grows is on no port";
  if (type.kind == Kind::kVector && type.element->kind == Kind::kArray) {
    return "a vector of arrays is no type of DDS: use a struct with the array in it";
  }
  if (type.element != nullptr) return dds_objection(*type.element);
  for (const Field& field : type.fields) {
    if (std::string why = dds_objection(*field.type); !why.empty()) return why;
  }
  return {};
}

std::string dds_idl(std::span<const Type* const> types) {
  std::vector<const Type*> structs;
  for (const Type* each : types) gather(*each, structs);
  std::string text = "module armature { module msg { module dds_ {\n";
  for (const Type* each : structs) {
    text += "  struct " + word_of(*each) + "_ {\n";
    for (const Field& field : each->fields) {
      text += "    " + member(*field.type, field.name) + remark(*field.type, field.unit) + "\n";
    }
    text += "  };\n";
  }
  std::vector<std::string> wrapped;
  for (const Type* each : types) {
    const std::string word = word_of(*each);
    if (each->kind == Kind::kStruct || std::ranges::find(wrapped, word) != wrapped.end()) continue;
    wrapped.push_back(word);
    text +=
        "  struct " + word + "_ {\n    " + member(*each, "data") + remark(*each, "") + "\n  };\n";
  }
  return text + "}; }; };\n";
}

}  // namespace armature::types
