// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/internal/shape.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace armature::foxglove::internal {
namespace {

using Fields = std::vector<inspect::FieldDescription>;

/// Deeper structs are shown no more: no type is so deep, and what a peer tells might be.
constexpr int kDeepestShape = 16;

Shape::Kind kind_of(const std::string& type) {
  if (type == "double" || type == "float") return Shape::Kind::kFloat;
  if (type == "bool") return Shape::Kind::kBool;
  if (type.starts_with("text")) return Shape::Kind::kText;
  const bool integer = type.starts_with("int") || type.starts_with("uint");
  return integer ? Shape::Kind::kInteger : Shape::Kind::kEnumeration;
}

Shape shape_at(const std::string& type, const Fields& fields, int depth);

/// `vector<double>`, `array<float,3>`.
Shape list_of(const std::string& type, const Fields& fields, int depth) {
  Shape list{Shape::Kind::kList, type};
  const bool array = type.starts_with("array<");
  const std::size_t begin = type.find('<') + 1;
  const std::size_t end = array ? type.rfind(',') : type.size() - 1;
  if (array && end != std::string::npos) {
    std::size_t count = 0;
    std::from_chars(type.data() + end + 1, type.data() + type.size(), count);
    list.count = count;
  }
  list.members.push_back(
      shape_at(type.substr(begin, std::max(end, begin) - begin), fields, depth + 1));
  return list;
}

Shape shape_at(const std::string& type, const Fields& fields, int depth) {
  if (depth < kDeepestShape && (type.starts_with("vector<") || type.starts_with("array<"))) {
    return list_of(type, fields, depth);
  }
  Shape shape{kind_of(type), type};
  if (depth >= kDeepestShape) return shape;
  for (const inspect::FieldDescription& field : fields) {
    if (field.structure != type) continue;
    shape.kind = Shape::Kind::kStruct;
    Shape& member = shape.members.emplace_back(shape_at(field.type, fields, depth + 1));
    member.name = field.name;
    member.about = about(field.doc, field.unit);
  }
  return shape;
}

const char* json_name(Shape::Kind kind) {
  switch (kind) {
    case Shape::Kind::kFloat:
      return "number";
    case Shape::Kind::kBool:
      return "boolean";
    case Shape::Kind::kText:
      return "string";
    case Shape::Kind::kList:
      return "array";
    case Shape::Kind::kStruct:
      return "object";
    case Shape::Kind::kInteger:
    case Shape::Kind::kEnumeration:
      break;
  }
  return "integer";
}

Json shape_json(const Shape& shape, const std::string& about) {
  Json json{{"type", json_name(shape.kind)}};
  if (shape.kind == Shape::Kind::kStruct) json["title"] = shape.type;
  if (!about.empty()) json["description"] = about;
  if (shape.kind == Shape::Kind::kList) json["items"] = shape_json(shape.members[0], {});
  if (shape.count) json["minItems"] = json["maxItems"] = *shape.count;
  if (shape.kind != Shape::Kind::kStruct) return json;
  for (const Shape& member : shape.members) {
    json["properties"][member.name] = shape_json(member, member.about);
  }
  return json;
}

}  // namespace

bool Shape::has_text() const {
  return kind == Kind::kText || std::ranges::any_of(members, &Shape::has_text);
}

Shape shape_of(const std::string& type, const Fields& fields) { return shape_at(type, fields, 0); }

std::string about(const std::string& doc, const std::string& unit) {
  if (unit.empty()) return doc;
  return doc + (doc.empty() ? "[" : " [") + unit + "]";
}

std::string schema_of(const Shape& shape, const std::string& about) {
  if (shape.kind == Shape::Kind::kStruct) return text_of(shape_json(shape, about));
  return text_of({{"type", "object"},
                  {"title", shape.type},
                  {"properties", {{"value", shape_json(shape, about)}}},
                  {"required", Json::array({"value"})}});
}

}  // namespace armature::foxglove::internal
