// SPDX-License-Identifier: Apache-2.0
#include "idl/internal/typescript_text.hpp"

#include <charconv>

#include "idl/internal/cpp_text.hpp"
#include "idl/number.hpp"

namespace armature::idl::internal {
namespace {

struct Scalar {
  std::string_view type;
  std::string_view description;
};

Scalar typescript_scalar(Basic basic) {
  switch (basic) {
    case Basic::kBool:
      return {"boolean", "ride.bool"};
    case Basic::kChar:
      return {"number", "ride.char"};
    case Basic::kByte:
      return {"number", "ride.byte"};
    case Basic::kShort:
      return {"number", "ride.short"};
    case Basic::kUnsignedShort:
      return {"number", "ride.unsignedShort"};
    case Basic::kInt:
      return {"number", "ride.int"};
    case Basic::kUnsignedInt:
      return {"number", "ride.unsignedInt"};
    case Basic::kLong:
      return {"bigint", "ride.long"};
    case Basic::kUnsignedLong:
      return {"bigint", "ride.unsignedLong"};
    case Basic::kFloat:
      return {"number", "ride.float"};
    case Basic::kDouble:
      return {"number", "ride.double"};
    case Basic::kString:
      return {"string", "ride.string"};
    default:
      return {"void", "ride.nothing"};
  }
}

bool is_wide(Basic basic) { return basic == Basic::kLong || basic == Basic::kUnsignedLong; }

/// One piece of memory rather than a list of numbers.
bool is_bytes(const Type& type) {
  return type.basic == Basic::kByte && type.form == Type::Form::kCounted;
}

std::string real(const std::string& text) {
  char digits[64];
  const double value = parse_real(text).value_or(0.0);
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

/// What would end the comment, ends it no more.
std::string harmless(std::string line) {
  for (std::size_t at = 0; (at = line.find("*/", at)) != std::string::npos;)
    line.insert(at + 1, "\\");
  return line;
}

}  // namespace

std::string TypescriptText::qualified(const std::string& name, const std::string& module) const {
  const bool ours = !elsewhere_ && module == program_.main().name;
  return (ours ? "" : names_.module(module) + ".") + names_.type(name);
}

std::string TypescriptText::module_of(const Type& type) const {
  return type.basic == Basic::kStruct ? program_.find_struct(type.name)->module
                                      : program_.find_enum(type.name)->module;
}

std::string TypescriptText::single(const Type& type) const {
  const bool named = type.basic == Basic::kStruct || type.basic == Basic::kEnum;
  return named ? qualified(type.name, module_of(type))
               : std::string(typescript_scalar(type.basic).type);
}

std::string TypescriptText::type(const Type& type) const {
  if (is_bytes(type)) return "Uint8Array";
  return single(type) + (type.is_array() ? "[]" : "");
}

std::string TypescriptText::description(const Field& field) const {
  return description(field.type, field.range ? &*field.range : nullptr);
}

std::string TypescriptText::description(const Type& type, const Range* range) const {
  if (is_bytes(type)) {
    return range == nullptr ? "ride.bytes" : "ride.bytesWithin(" + bounds(*range, type.basic) + ")";
  }
  const bool named = type.basic == Basic::kStruct || type.basic == Basic::kEnum;
  std::string text = named ? single(type) : std::string(typescript_scalar(type.basic).description);
  if (range != nullptr) text = "ride.within(" + text + ", " + bounds(*range, type.basic) + ")";
  if (type.form == Type::Form::kCounted) return "ride.array(" + text + ")";
  if (type.form == Type::Form::kSingle) return text;
  return "ride.fixed(" + text + ", " + std::to_string(type.count) + ")";
}

std::string TypescriptText::bounds(const Range& range, Basic type) const {
  const auto bound = [&](const std::string& text) {
    return is_whole_number(type) ? number(parse_whole(text).value_or(Whole{}), type) : real(text);
  };
  return bound(range.low) + ", " + bound(range.high);
}

std::string TypescriptText::underlying(const Enumeration& enumeration) const {
  return std::string(typescript_scalar(enumeration.underlying).description);
}

std::string TypescriptText::number(const Whole& value, Basic type) {
  return to_text(value) + (is_wide(type) ? "n" : "");
}

std::string TypescriptText::documentation(std::size_t indent,
                                          const std::vector<std::string>& lines) {
  std::vector<std::string> safe;
  for (const std::string& line : lines) safe.push_back(harmless(line));
  const std::string blanks(indent, ' ');
  const std::string all = comment(indent, safe);
  if (all.empty()) return {};
  std::vector<std::string> parts;
  for (std::size_t at = 0; at < all.size(); at = all.find('\n', at) + 1) {
    parts.push_back(all.substr(at + indent + 3, all.find('\n', at) - at - indent - 3));
  }
  if (parts.size() == 1 && indent + parts[0].size() + 6 <= kColumns) {
    return blanks + "/**" + parts[0] + " */\n";
  }
  std::string text = blanks + "/**\n";
  for (const std::string& part : parts) text += blanks + " *" + part + "\n";
  return text + blanks + " */\n";
}

}  // namespace armature::idl::internal
