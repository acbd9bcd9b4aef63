// SPDX-License-Identifier: Apache-2.0
#include "armature/document/property_value.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/base/unit.hpp"
#include "armature/document/internal/number_text.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/types/enum.hpp"

namespace armature::document {
namespace {

using types::Kind;
using types::Type;

void* at_offset(void* base, std::size_t offset) { return static_cast<std::byte*>(base) + offset; }
const void* at_offset(const void* base, std::size_t offset) {
  return static_cast<const std::byte*>(base) + offset;
}

std::optional<bool> parse_bool(std::string text) {
  constexpr std::array<std::string_view, 4> kTrue = {"true", "yes", "on", "1"};
  constexpr std::array<std::string_view, 4> kFalse = {"false", "no", "off", "0"};
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  if (std::find(kTrue.begin(), kTrue.end(), text) != kTrue.end()) return true;
  if (std::find(kFalse.begin(), kFalse.end(), text) != kFalse.end()) return false;
  return std::nullopt;
}

/// Elements of a list: its items, or the entries of an OROCOS bag that numbers them, as `Element0`,
/// `Element1` after a `Size`. Nothing if it is neither.
std::optional<std::vector<const Value*>> elements_of(const Value& written) {
  std::vector<const Value*> elements;
  for (const Value& item : written.items) elements.push_back(&item);
  if (written.kind == Value::Kind::kList) return elements;
  std::string_view prefix;
  std::size_t number = 0;
  for (const Property& entry : written.entries) {
    const std::string_view name = entry.name;
    if (name == "Size") continue;
    if (elements.empty()) {
      prefix = name.substr(0, name.find_last_not_of("0123456789") + 1);
      number = name.substr(prefix.size()) == "1" ? 1 : 0;
    }
    if (name != std::string(prefix) + std::to_string(number)) return std::nullopt;
    elements.push_back(&entry.value);
    ++number;
  }
  return elements.empty() ? std::nullopt : std::optional(elements);
}

/// Puts what was written into the memory of a value.
class Filler {
 public:
  /// @param names_unit  the property that names the unit; nullptr: none does
  Filler(std::string_view subject, base::Diagnostics& diagnostics,
         const component::PropertyBase* names_unit = nullptr)
      : subject_(subject), diagnostics_(diagnostics), names_unit_(names_unit) {}

  bool fill(const Value& written, const Type& type, std::string_view unit, void* at) {
    switch (type.kind) {
      case Kind::kArray:
      case Kind::kVector:
        return fill_list(written, type, unit, at);
      case Kind::kStruct:
        return fill_struct(written, type, at);
      default:
        break;
    }
    if (written.kind != Value::Kind::kText) {
      return fail(written.where, "expected " + expected_text(type, unit) + ", found " +
                                     std::string(name_of(written.kind)));
    }
    if (type.kind == Kind::kBool) return fill_bool(written, at);
    if (type.kind == Kind::kEnum) return fill_enumerator(written, type, at);
    if (type.kind == Kind::kText || type.kind == Kind::kFixedText) {
      return fill_text(written, type, at);
    }
    const std::string problem = parse_number(written.text, type, unit, at);
    return problem.empty() || fail(written.where, problem, unit_to_name(written.text, unit));
  }

 private:
  /// What to do about a number with a unit where nothing names one.
  base::Hint unit_to_name(const std::string& text, std::string_view unit) const {
    const auto quantity = base::parse_quantity(text);
    const bool lacks_one = names_unit_ != nullptr && unit.empty() && quantity.ok();
    if (!lacks_one || quantity.value().unit.empty()) return {};
    return "name its unit: " + std::string(names_unit_->name()) + ": " + quantity.value().unit;
  }

  bool fill_bool(const Value& written, void* at) {
    const std::optional<bool> flag = parse_bool(written.text);
    if (!flag) {
      return fail(written.where, "expected true or false, found " + in_quotes(written.text));
    }
    *static_cast<bool*>(at) = *flag;
    return true;
  }

  bool fill_enumerator(const Value& written, const Type& type, void* at) {
    const types::Enumerator* const found = types::find_enumerator(type, written.text);
    if (found == nullptr) {
      return fail(written.where, types::unknown_enumerator(type, written.text),
                  types::near_enumerator(type, written.text));
    }
    types::set_enumerator(type, *found, at);
    return true;
  }

  bool fill_text(const Value& written, const Type& type, void* at) {
    const bool fits = type.kind == Kind::kText || written.text.size() <= type.count;
    if (!fits) {
      return fail(written.where,
                  in_quotes(written.text) + " has " + std::to_string(written.text.size()) +
                      " bytes, more than the " + std::to_string(type.count) + " that fit");
    }
    type.set_text(at, written.text);
    return true;
  }

  bool fill_list(const Value& written, const Type& type, std::string_view unit, void* at) {
    const auto elements = elements_of(written);
    if (!elements) {
      return fail(written.where, "expected a list of " + type.element->name + ", found " +
                                     std::string(name_of(written.kind)));
    }
    const std::size_t count = elements->size();
    if (type.kind == Kind::kArray && count != type.count) {
      return fail(written.where, "expected " + std::to_string(type.count) + " elements, found " +
                                     std::to_string(count));
    }
    if (type.kind == Kind::kVector) type.vector_resize(at, count);
    void* const first = type.kind == Kind::kVector ? type.vector_data(at) : at;
    bool good = true;
    for (std::size_t i = 0; i < count; ++i) {
      const Inside inside(*this, "[" + std::to_string(i) + "]");
      good &= fill(*(*elements)[i], *type.element, unit, at_offset(first, i * type.element->size));
    }
    return good;
  }

  bool fill_struct(const Value& written, const Type& type, void* at) {
    if (written.kind != Value::Kind::kMap) {
      return fail(written.where, "expected a map with the fields of " + type.name + ", found " +
                                     std::string(name_of(written.kind)));
    }
    bool good = refuse_unknown_fields(written, type);
    for (const types::Field& field : type.fields) {
      const Property* given = find(written.entries, field.name);
      if (given == nullptr) {
        good = fail(written.where, "field " + in_quotes(field.name) + " is missing",
                    std::string(field.doc));
        continue;
      }
      const Inside inside(*this, (path_.empty() ? "" : ".") + std::string(field.name));
      good &= fill(given->value, *field.type, field.unit, at_offset(at, field.offset));
    }
    return good;
  }

  bool refuse_unknown_fields(const Value& written, const Type& type) {
    std::vector<std::string> names;
    for (const types::Field& field : type.fields) names.emplace_back(field.name);
    bool good = true;
    for (const Property& entry : written.entries) {
      if (std::find(names.begin(), names.end(), entry.name) != names.end()) continue;
      good = fail(entry.where, type.name + " has no field " + in_quotes(entry.name),
                  base::suggestion(entry.name, names));
    }
    return good;
  }

  /// Extends the path while one of the parts of a value is filled.
  class Inside {
   public:
    Inside(Filler& filler, std::string_view part) : path_(filler.path_), outside_(path_.size()) {
      path_ += part;
    }
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;
    ~Inside() { path_.resize(outside_); }

   private:
    std::string& path_;
    std::size_t outside_;
  };

  bool fail(const base::Location& where, const std::string& problem, base::Hint hint = {}) {
    std::string subject(subject_);
    if (!path_.empty()) subject += ", part " + in_quotes(path_);
    diagnostics_.error(where, subject + ": " + problem, std::move(hint));
    return false;
  }

  std::string_view subject_;
  base::Diagnostics& diagnostics_;
  const component::PropertyBase* names_unit_;
  std::string path_;
};

/// The OROCOS type that a property file names for values of a type; empty where the value shows it.
std::string_view orocos_type(const Type& type) {
  switch (type.kind) {
    case Kind::kBool:
      return "boolean";
    case Kind::kInt8:
    case Kind::kInt16:
      return "short";
    case Kind::kUint8:
    case Kind::kUint16:
      return "ushort";
    case Kind::kInt32:
      return "long";
    case Kind::kUint32:
      return "ulong";
    case Kind::kInt64:
      return "llong";
    case Kind::kUint64:
      return "ullong";
    case Kind::kFloat:
      return "float";
    case Kind::kDouble:
      return "double";
    case Kind::kEnum:
    case Kind::kText:
    case Kind::kFixedText:
      return "string";
    default:
      return "";
  }
}

std::string_view orocos_list_type(const Type& element) {
  const std::string_view type = orocos_type(element);
  if (type == "double" || type == "float") return "array";
  if (type == "string" || type == "boolean") return "strings";
  return type.empty() ? "" : "ints";
}

Value write_list(const Type& type, const void* list) {
  Value written = make_list();
  written.type = orocos_list_type(*type.element);
  const bool vector = type.kind == Kind::kVector;
  const std::size_t count = vector ? type.vector_size(list) : type.count;
  const void* const first = vector ? type.vector_data(const_cast<void*>(list)) : list;
  for (std::size_t i = 0; i < count; ++i) {
    written.items.push_back(write_value(*type.element, at_offset(first, i * type.element->size)));
    written.items.back().type.clear();
  }
  return written;
}

Value write_struct(const Type& type, const void* value) {
  Value written = make_map();
  for (const types::Field& field : type.fields) {
    written.entries.push_back({std::string(field.name),
                               write_value(*field.type, at_offset(value, field.offset)),
                               std::string(field.doc),
                               {}});
  }
  return written;
}

}  // namespace

std::optional<types::Value> make_value(const Value& written, const Type& type,
                                       std::string_view unit, std::string_view subject,
                                       base::Diagnostics& diagnostics) {
  types::Value value(type);
  if (!Filler(subject, diagnostics).fill(written, type, unit, value.data())) return std::nullopt;
  return value;
}

Value write_value(const Type& type, const void* value) {
  if (type.kind == Kind::kArray || type.kind == Kind::kVector) return write_list(type, value);
  if (type.kind == Kind::kStruct) return write_struct(type, value);
  Value written = make_text(types::to_text(type, value));
  written.type = orocos_type(type);
  written.literal = true;
  return written;
}

namespace {

/// What is written for a property that takes a boolean besides its own type: that of a file that
/// says so, or the word.
const Type& type_of_written(const component::PropertyBase& property, const Value& written) {
  const Type& boolean = types::type_of<bool>();
  const bool word = written.text == "true" || written.text == "false";
  const bool said = word || written.type == orocos_type(boolean);
  const bool takes_it = property.is_sign() && written.kind == Value::Kind::kText;
  return takes_it && said ? boolean : property.type();
}

}  // namespace

bool set_property(component::PropertyBase& property, const Value& written,
                  base::Diagnostics& diagnostics) {
  const std::string subject =
      "property " + in_quotes(property.name()) + " of " + in_quotes(property.owner().name());
  types::Value value(type_of_written(property, written));
  Filler filler(subject, diagnostics, property.unit_property());
  if (!filler.fill(written, value.type(), property.unit(), value.data())) return false;
  const base::Result<void> set = property.set(value);
  if (!set) diagnostics.error(written.where, set.error());
  return set.ok();
}

}  // namespace armature::document
