// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "armature/base/xml_text.hpp"
#include "armature/document/typed_text.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/orocos/internal/xml_tree.hpp"

namespace armature::orocos {

using namespace document;
namespace {

Value simple_value(const XmlElement& element, base::Diagnostics& diagnostics) {
  const std::string type = element.type.empty() ? "string" : element.type;
  Value value = make_text(element.text, element.where);
  if (!is_simple_type(type)) {
    diagnostics.error(element.where,
                      "simple " + in_quotes(element.name) + ": unknown type " + in_quotes(type),
                      "for example long, double, boolean or string");
    return value;
  }
  value.type = type;
  normalise_type(value);
  if (const std::string wrong = wrong_with(value); !wrong.empty()) {
    diagnostics.error(element.where,
                      "simple " + in_quotes(element.name) + " of type " + type + " " + wrong);
    value.type.clear();
  }
  return value;
}

/// An element of `array`, `ints` or `strings` is of the list's element type without saying so.
Value element_value(const XmlElement& element, std::string_view expected,
                    base::Diagnostics& diagnostics) {
  if (!element.is_simple()) {
    diagnostics.error(element.where, "a list of this type has only simple elements",
                      "use <sequence> for others");
  }
  const bool text = is_text_type(expected);
  Value value = make_text(text ? element.text : std::string(trimmed(element.text)), element.where);
  value.type = expected;
  if (const std::string wrong = wrong_with(value); !wrong.empty()) {
    diagnostics.error(element.where, "an element of the list " + wrong);
  }
  value.type.clear();
  return value;
}

Value list_value(const XmlElement& element, base::Diagnostics& diagnostics) {
  Value list = make_list(element.where);
  const std::string_view expected = element_type_of(element.type);
  for (const XmlElement& child : element.children) {
    if (child.is_simple() && child.name == "Size") continue;
    list.items.push_back(expected.empty() ? value_of(child, diagnostics)
                                          : element_value(child, expected, diagnostics));
  }
  if (!expected.empty()) list.type = element.type;
  if (!wrong_with(list).empty()) list.type.clear();  // reported for the element
  normalise_type(list);
  return list;
}

bool is_list(const XmlElement& element) {
  return element.kind == XmlElement::Kind::kSequence || is_list_type(element.type);
}

/// True if each entry has a name of its own. OROCOS allows several of one name, and none.
bool has_own_names(const XmlElement& bag) {
  std::unordered_set<std::string_view> names;
  return std::all_of(bag.children.begin(), bag.children.end(), [&](const XmlElement& child) {
    return !child.name.empty() && names.insert(child.name).second;
  });
}

/// A bag whose entries cannot be told apart by name, as a list.
Value values_of(const XmlElement& bag, base::Diagnostics& diagnostics) {
  Value list = make_list(bag.where);
  bool alike = true;
  for (const XmlElement& child : bag.children) {
    alike &= child.name == bag.children.front().name;
    list.items.push_back(value_of(child, diagnostics));
  }
  if (!alike) {
    diagnostics.named_warning("names_left_out", bag.where,
                              "struct " + in_quotes(bag.name) +
                                  " has entries of the same name or without one: it is read "
                                  "as the list of their values, names are left out");
  }
  normalise_type(list);
  return list;
}

/// Tabs and line ends, too, which a reader of XML would make blanks.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : base::xml_escaped(text)) {
    const bool blank = c == '\t' || c == '\n' || c == '\r';
    result += blank ? "&#" + std::to_string(static_cast<int>(c)) + ";" : std::string(1, c);
  }
  return result;
}

}  // namespace

Value value_of(const XmlElement& element, base::Diagnostics& diagnostics) {
  if (element.is_simple()) return simple_value(element, diagnostics);
  if (is_list(element)) return list_value(element, diagnostics);
  const bool plain =
      element.type.empty() || element.type == "PropertyBag" || element.type == "type_less";
  if (plain && !has_own_names(element)) return values_of(element, diagnostics);
  Value map = make_map(element.where);
  map.entries = properties_of(element, diagnostics);
  if (plain) return map;
  map.type = element.type;
  if (!is_struct_type(element.type)) {
    diagnostics.error(
        element.where,
        "struct " + in_quotes(element.name) + ": unknown type " + in_quotes(element.type),
        "for example PropertyBag or array");
  }
  return map;
}

std::vector<Property> properties_of(const XmlElement& element, base::Diagnostics& diagnostics) {
  std::vector<Property> properties;
  std::unordered_map<std::string_view, const base::Location*> first;
  for (const XmlElement& child : element.children) {
    if (child.name.empty()) {
      diagnostics.error(child.where, "a property needs a name", "add name=\"...\"");
      continue;
    }
    const auto [earlier, is_new] = first.emplace(child.name, &child.where);
    if (!is_new) {
      diagnostics.error(child.where, in_quotes(child.name) + " is given twice",
                        "first at " + place_text(*earlier->second));
      continue;
    }
    properties.push_back(
        {child.name, value_of(child, diagnostics), child.description, child.where});
  }
  return properties;
}

XmlWriter::XmlWriter()
    : text_(
          "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
          "<!DOCTYPE properties SYSTEM \"cpf.dtd\">\n") {}

void XmlWriter::indent() { text_.append(open_.size() * 2, ' '); }

void XmlWriter::tag(std::string_view name, const Attributes& attributes) {
  text_ += "<" + std::string(name);
  for (const auto& [key, value] : attributes) {
    if (!value.empty()) text_ += " " + key + "=\"" + escaped(value) + "\"";
  }
  text_ += ">";
}

void XmlWriter::open(std::string_view name, const Attributes& attributes) {
  indent();
  tag(name, attributes);
  text_ += "\n";
  open_.emplace_back(name);
}

void XmlWriter::close() {
  const std::string name = std::move(open_.back());
  open_.pop_back();
  indent();
  text_ += "</" + name + ">\n";
}

void XmlWriter::simple(const Attributes& attributes, std::string_view text,
                       std::string_view description) {
  indent();
  tag("simple", attributes);
  if (!description.empty()) text_ += "<description>" + escaped(description) + "</description>";
  text_ += "<value>" + escaped(text) + "</value></simple>\n";
}

void XmlWriter::description(const Property& property) {
  if (property.description.empty()) return;
  indent();
  text_ += "<description>" + escaped(property.description) + "</description>\n";
}

void XmlWriter::list(const Property& property) {
  const Value& value = property.value;
  // In a <sequence> each element says its own type; the other lists say one for all of them.
  const bool alike = std::all_of(value.items.begin(), value.items.end(), [](const Value& item) {
    return item.kind == Value::Kind::kText && item.type.empty();
  });
  const std::string type = !alike               ? ""
                           : value.type.empty() ? std::string(shown_list_type(value))
                                                : value.type;
  open(alike ? "struct" : "sequence", {{"name", property.name}, {"type", type}});
  description(property);
  const std::string element_type(element_type_of(type));
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    Value item = value.items[i];
    if (alike) item.type = element_type;
    this->property({"Element" + std::to_string(i), std::move(item), {}, {}});
  }
  close();
}

void XmlWriter::property(const Property& property) {
  const Value& value = property.value;
  switch (value.kind) {
    case Value::Kind::kNone:
      break;
    case Value::Kind::kText: {
      const std::string type =
          value.type.empty() ? std::string(shown_type(value.text)) : value.type;
      simple({{"name", property.name}, {"type", type}}, value.text, property.description);
      break;
    }
    case Value::Kind::kList:
      list(property);
      break;
    case Value::Kind::kMap:
      open("struct",
           {{"name", property.name}, {"type", value.type.empty() ? "PropertyBag" : value.type}});
      description(property);
      for (const Property& entry : value.entries) this->property(entry);
      close();
      break;
  }
}

}  // namespace armature::orocos
