// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/document/document.hpp"
#include "armature/document/limits.hpp"

namespace armature::orocos {

using namespace document;

/// A `simple`, `struct`, `sequence` or `properties` element of an OROCOS file.
struct XmlElement {
  enum class Kind { kSimple, kStruct, kSequence };

  Kind kind = Kind::kStruct;
  std::string name;
  std::string type;
  std::string text;  ///< of `value`
  std::string description;
  std::vector<XmlElement> children;
  std::vector<std::pair<std::string, std::string>> extras;  ///< `armature:key="value"`
  base::Location where;

  bool is_simple() const { return kind == Kind::kSimple; }
};

/// The `properties` element of an OROCOS file, checked for its structure; nothing if it is not XML.
std::optional<XmlElement> parse_orocos_xml(std::string_view text, const std::string& file,
                                           const Limits& limits, base::Diagnostics& diagnostics);

/// What an element holds: a simple's text, checked against its type; lists for sequences and
/// arrays; maps for other structs.
Value value_of(const XmlElement& element, base::Diagnostics& diagnostics);

/// The element's children as properties.
std::vector<Property> properties_of(const XmlElement& element, base::Diagnostics& diagnostics);

/// Writes elements with their indentation.
class XmlWriter {
 public:
  XmlWriter();

  /// Attributes whose value is empty are left out.
  using Attributes = std::vector<std::pair<std::string, std::string>>;
  void open(std::string_view tag, const Attributes& attributes);
  void close();
  void simple(const Attributes& attributes, std::string_view text,
              std::string_view description = {});
  void property(const Property& property);

  std::string take() { return std::move(text_); }

 private:
  void indent();
  void tag(std::string_view name, const Attributes& attributes);
  void description(const Property& property);
  void list(const Property& property);

  std::string text_;
  std::vector<std::string> open_;
};

}  // namespace armature::orocos
