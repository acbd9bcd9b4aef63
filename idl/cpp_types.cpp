// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>

#include "idl/canonical.hpp"
#include "idl/internal/cpp_text.hpp"
#include "idl/internal/structure_order.hpp"

namespace armature::idl::internal {
namespace {

class TypesWriter {
 public:
  explicit TypesWriter(const CppText& text) : text_(text), names_(text.names()) {}

  std::string run() {
    std::string body;
    for (const Enumeration& each : text_.main().enumerations) body += "\n" + written(each);
    for (const Structure* structure : in_order_of_use(text_.program())) {
      body += "\n" + written(*structure);
    }
    for (const Interface& interface : text_.main().interfaces) body += "\n" + written(interface);
    return text_.head(true) + includes() + "\n" + text_.begin_name_space() + body +
           text_.end_name_space();
  }

 private:
  std::string includes() const {
    const auto uses = [&](const std::function<bool(const Type&)>& condition) {
      return any_type(condition);
    };
    std::string text;
    if (uses([](const Type& type) { return type.form == Type::Form::kFixed; })) {
      text += "#include <array>\n";
    }
    text += "#include <cstdint>\n";
    if (uses([](const Type& type) { return type.basic == Basic::kString; })) {
      text += "#include <string>\n";
    }
    if (uses([](const Type& type) { return type.form == Type::Form::kCounted; })) {
      text += "#include <vector>\n";
    }
    const bool has_enums = !text_.main().enumerations.empty();
    text += "\n#include \"armature/ride/codec.hpp\"\n";
    if (has_enums) text += "#include \"armature/ride/enumeration.hpp\"\n";
    text += "#include \"armature/ride/interface.hpp\"\n#include \"armature/ride/range.hpp\"\n";
    if (has_enums) text += "#include \"armature/types/enum.hpp\"\n";
    text += "#include \"armature/types/struct.hpp\"\n";
    std::vector<std::string> imported;
    for (const Import& import : text_.main().imports) imported.push_back(import.module);
    std::sort(imported.begin(), imported.end());
    imported.erase(std::unique(imported.begin(), imported.end()), imported.end());
    for (const std::string& module : imported) text += "#include \"" + module + "_types.hpp\"\n";
    return text;
  }

  /// Also those of operations: client and service include no standard header for them.
  bool any_type(const std::function<bool(const Type&)>& condition) const {
    const auto any = [&](const std::vector<Field>& fields) {
      return std::any_of(fields.begin(), fields.end(),
                         [&](const Field& field) { return condition(field.type); });
    };
    for (const Structure& structure : text_.main().structures) {
      if (any(structure.members)) return true;
    }
    for (const Interface& interface : text_.main().interfaces) {
      for (const Operation& operation : interface.operations) {
        if (condition(operation.result) || any(operation.parameters)) return true;
      }
    }
    return false;
  }

  std::string written(const Enumeration& enumeration) const {
    const std::string name = names_.type(enumeration.name);
    const std::string stored = CppText::underlying(enumeration);
    std::string text =
        comment(0, enumeration.doc) + declaration(0, "enum class " + name, ": " + stored + " {");
    Items described{name};
    for (const Enumerator& each : enumeration.enumerators) {
      described.push_back(names_.enumerator(each.name));
      text += comment(2, each.doc) +
              declaration(2, described.back() + " =", CppText::value(each) + ",");
    }
    return text + "};\n" + list(0, "ARMATURE_ENUM(", described, ");") +
           defined(0, {"inline void", "encode", {"armature::ride::Encoder& to", name + " value"}},
                   "  to.put(static_cast<" + stored + ">(value));\n") +
           defined(0,
                   {"inline bool", "decode", {"armature::ride::Decoder& from", name + "& value"}},
                   "  return from.take_enumerator(value);\n");
  }

  std::string written(const Structure& structure) const {
    std::string text = comment(0, structure.doc) + "struct " + type(structure) + " {\n";
    for (const Field& member : structure.members) text += line_of(member);
    return text + "};\n" + description(structure) + encoder(structure) + decoder(structure) +
           range_check(structure) + event_number(structure);
  }

  std::string line_of(const Field& member) const {
    return comment(2, CppText::described(member)) +
           declaration(2, text_.type(member.type),
                       names_.member(member.name) + text_.initial(member.type) + ";");
  }

  std::string description(const Structure& structure) const {
    Items items{names_.type(structure.name)};
    for (const Field& member : structure.members) items.push_back(described_field(member));
    return list(0, "ARMATURE_STRUCT(", items, ");");
  }

  /// `x`, or `(x, "px", "column")`.
  std::string described_field(const Field& member) const {
    const std::string name = names_.member(member.name);
    const std::string doc = member.doc.empty() ? "" : member.doc.front();
    if (member.unit.empty() && doc.empty()) return name;
    Items parts{name, literal(member.unit)};
    if (!doc.empty()) parts.push_back(long_literal(8, doc, ' '));
    return item(4, "(", parts, ")");
  }

  std::string encoder(const Structure& structure) const {
    std::string body;
    for (const Field& member : structure.members) {
      const std::string put = is_flags(member.type) ? "to.put_flags(" : "to.put(";
      body += "  " + put + "value." + names_.member(member.name) + ");\n";
    }
    return defined(0,
                   {"inline void",
                    "encode",
                    {"armature::ride::Encoder& to", "const " + type(structure) + "& value"}},
                   body);
  }

  std::string decoder(const Structure& structure) const {
    Items checks;
    for (const Field& member : structure.members) {
      const std::string take = is_flags(member.type) ? "from.take_flags(" : "from.take(";
      checks.push_back(take + "value." + names_.member(member.name) + ")");
    }
    for (const Field& member : structure.members) {
      if (member.range) checks.push_back("from.within(" + ranged(member) + ", value)");
    }
    return defined(
        0,
        {"inline bool", "decode", {"armature::ride::Decoder& from", type(structure) + "& value"}},
        all_of(checks));
  }

  /// A member with the bounds of its range.
  std::string ranged(const Field& member) const {
    const Items bounds = text_.bounds(*member.range, member.type.basic);
    return "value." + names_.member(member.name) + ", " + bounds[0] + ", " + bounds[1];
  }

  std::string range_check(const Structure& structure) const {
    if (!text_.has_range(structure)) return {};
    Items checks;
    for (const Field& member : structure.members) {
      const std::string value = "value." + names_.member(member.name);
      if (member.range) checks.push_back("armature::ride::within(" + ranged(member) + ")");
      if (!text_.has_range(member.type)) continue;
      checks.push_back((member.type.is_array() ? "armature::ride::all_in_range(" : "in_range(") +
                       value + ")");
    }
    return defined(0, {"inline bool", "in_range", {"const " + type(structure) + "& value"}},
                   all_of(checks));
  }

  std::string event_number(const Structure& structure) const {
    if (!structure.is_event) return {};
    const std::string number = hexadecimal(number_of(canonical(text_.program(), structure)));
    return defined(
        0, {"constexpr armature::ride::Number", "event_number", {"const " + type(structure) + "*"}},
        "  return " + number + ";\n");
  }

  static std::string all_of(const Items& checks) { return chain(2, "return ", checks, "&&", ";"); }

  std::string type(const Structure& structure) const { return names_.type(structure.name); }

  std::string written(const Interface& interface) const {
    const std::string constant = names_.constant(interface);
    const std::string number = hexadecimal(digest(text_.program(), interface));
    Items declarations;
    for (const Operation& operation : interface.operations) {
      declarations.push_back(entry(canonical(text_.program(), operation), operation.access));
    }
    for (const EventName& event : interface.events) {
      const Structure& structure = *text_.program().find_event(event.name);
      declarations.push_back(entry(canonical(text_.program(), structure), Access::kRead));
    }
    return comment(0, {"What interface " + interface.name +
                       " has; both sides compare its digest, " + number + "."}) +
           list_of(0, "inline constexpr armature::ride::Declaration",
                   constant + "Declarations[] = {", declarations, "};") +
           list_of(0, "inline constexpr armature::ride::Interface", constant + "{",
                   {literal(interface.name), constant + "Declarations"}, "};");
  }

  static std::string entry(const std::string& canonical, Access access) {
    std::string name(name_of(access));
    name.front() = static_cast<char>(name.front() - 'a' + 'A');
    return item(4, "{", {long_literal(8, canonical, ','), "armature::ride::Access::k" + name}, "}");
  }

  const CppText& text_;
  const CppNames& names_;
};

}  // namespace

std::string write_types(const CppText& text) { return TypesWriter(text).run(); }

}  // namespace armature::idl::internal
