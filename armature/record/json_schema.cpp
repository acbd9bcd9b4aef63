// SPDX-License-Identifier: Apache-2.0
#include "armature/record/internal/json_text.hpp"
#include "armature/record/json.hpp"
#include "armature/record/ros_types.hpp"

namespace armature::record {
namespace {

using internal::append_json_string;
using types::Field;
using types::Kind;
using types::Type;

/// The documentation with the unit in brackets, `ahead of the dock [m]`.
std::string description(const Field& field) {
  std::string text(field.doc);
  if (!field.unit.empty()) {
    if (!text.empty()) text += ' ';
    text += "[" + std::string(field.unit) + "]";
  }
  return text;
}

std::string_view json_name(const Type& type) {
  if (types::is_text(type) || type.kind == Kind::kEnum) return "string";
  if (types::is_list(type)) return "array";
  if (internal::is_float(type)) return "number";
  if (type.kind == Kind::kStruct) return "object";
  return type.kind == Kind::kBool ? "boolean" : "integer";
}

void append_schema(const Type& type, const std::string& about, std::string& to);

void append_members(const std::vector<Field>& fields, std::string& to) {
  std::string required;
  to += R"(,"properties":{)";
  for (const Field& field : fields) {
    if (!required.empty()) {
      to += ',';
      required += ',';
    }
    append_json_string(field.name, to);
    append_json_string(field.name, required);
    to += ':';
    append_schema(*field.type, description(field), to);
  }
  to += R"(},"required":[)" + required + "]";
}

void append_elements(const Type& list, std::string& to) {
  to += R"(,"items":)";
  append_schema(*list.element, {}, to);
  if (list.kind != Kind::kArray) return;
  const std::string count = std::to_string(list.count);
  to += R"(,"minItems":)" + count + R"(,"maxItems":)" + count;
}

void append_names(const Type& type, std::string& to) {
  to += R"(,"enum":[)";
  for (const types::Enumerator& each : type.enumerators) {
    if (&each != &type.enumerators.front()) to += ',';
    append_json_string(each.name, to);
  }
  to += ']';
}

void append_schema(const Type& type, const std::string& about, std::string& to) {
  to += R"({"type":)";
  append_json_string(json_name(type), to);
  if (type.kind == Kind::kStruct) {
    to += R"(,"title":)";
    append_json_string(type.name, to);
  }
  if (!about.empty()) {
    to += R"(,"description":)";
    append_json_string(about, to);
  }
  if (type.kind == Kind::kStruct) append_members(type.fields, to);
  if (types::is_list(type)) append_elements(type, to);
  if (type.kind == Kind::kEnum) append_names(type, to);
  to += '}';
}

}  // namespace

std::string json_schema_name(const Type& type) {
  const bool foxgloves = types::same_type(type, types::type_of<ros::FrameTransforms>());
  return foxgloves ? "foxglove.FrameTransforms" : type.name;
}

std::string json_schema(const Type& type) {
  std::string schema;
  if (type.kind == Kind::kStruct) {
    append_schema(type, {}, schema);
  } else {
    schema = R"({"type":"object","title":)";
    append_json_string(type.name, schema);
    append_members({{internal::kValueMember, 0, &type, {}, {}}}, schema);
    schema += '}';
  }
  return schema;
}

}  // namespace armature::record
