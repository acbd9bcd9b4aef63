// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>

#include "armature/base/utf8.hpp"
#include "idl/canonical.hpp"
#include "idl/internal/cpp_text.hpp"

namespace armature::idl::internal {
namespace {

class TypesWriter {
 public:
  explicit TypesWriter(const CppText& text) : text_(text), names_(text.names()) {}

  std::string run() {
    std::string body;
    for (const Structure* structure : in_order()) body += "\n" + written(*structure);
    for (const Interface& interface : text_.main().interfaces) body += "\n" + written(interface);
    return text_.head(true) + includes() + "\n" + text_.begin_name_space() + body +
           text_.end_name_space();
  }

 private:
  /// What a struct contains stands before it; otherwise as in the file.
  std::vector<const Structure*> in_order() const {
    std::vector<const Structure*> ordered;
    const std::function<void(const Structure&)> add = [&](const Structure& structure) {
      const bool done = std::find(ordered.begin(), ordered.end(), &structure) != ordered.end();
      if (done || structure.module != text_.main().name) return;
      for (const Field& member : structure.members) {
        if (member.type.basic != Basic::kStruct) continue;
        add(*text_.program().find_struct(member.type.structure));
      }
      ordered.push_back(&structure);
    };
    for (const Structure& structure : text_.main().structures) add(structure);
    return ordered;
  }

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
    text += "\n#include \"armature/ride/codec.hpp\"\n#include \"armature/ride/interface.hpp\"\n";
    text += "#include \"armature/ride/range.hpp\"\n#include \"armature/types/struct.hpp\"\n";
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

  std::string written(const Structure& structure) const {
    const std::string name = names_.type(structure.name);
    std::string text = comment(0, structure.doc) + "struct " + name + " {\n";
    for (const Field& member : structure.members) text += declared(member);
    return text + "};\n" + description(structure) + encoder(structure) + decoder(structure) +
           range_check(structure) + event_number(structure);
  }

  std::string declared(const Field& member) const {
    const std::string type = text_.type(member.type);
    const std::string name = names_.member(member.name) + CppText::initial(member.type) + ";";
    const bool fits = 3 + base::columns_of(type) + base::columns_of(name) <= kColumns;
    return comment(2, CppText::described(member)) + "  " + type + (fits ? " " : "\n      ") + name +
           "\n";
  }

  std::string description(const Structure& structure) const {
    Items items{names_.type(structure.name)};
    for (const Field& member : structure.members) items.push_back(described_field(member));
    return macro("ARMATURE_STRUCT(", items, ");");
  }

  /// `x`, or `(x, "px", "column")`, of which the documentation is cut where it would not fit.
  std::string described_field(const Field& member) const {
    const std::string name = names_.member(member.name);
    const std::string doc = member.doc.empty() ? "" : member.doc.front();
    if (member.unit.empty() && doc.empty()) return name;
    const std::string begin = "(" + name + ", " + literal(member.unit);
    if (doc.empty()) return begin + ")";
    // "ARMATURE_STRUCT(" before it; `, ` and `));` around it.
    const std::size_t used = 16 + base::columns_of(begin) + 5;
    return begin + ", " + fitting_literal(doc, kColumns - std::min(used, kColumns - 8)) + ")";
  }

  /// A literal of at most `columns`, which ends in `...` if `text` is longer.
  static std::string fitting_literal(const std::string& text, std::size_t columns) {
    if (base::columns_of(literal(text)) <= columns) return literal(text);
    std::string_view shorter = text;
    while (!shorter.empty()) {
      const std::size_t blank = shorter.rfind(' ');
      shorter = shorter.substr(0, blank == std::string_view::npos ? 0 : blank);
      const std::string cut = literal(std::string(shorter) + " ...");
      if (!shorter.empty() && base::columns_of(cut) <= columns) return cut;
    }
    return "\"...\"";
  }

  std::string encoder(const Structure& structure) const {
    const Function head{
        "inline void",
        "",
        "encode",
        {"armature::ride::Encoder& to", "const " + names_.type(structure.name) + "& value"},
        " {"};
    Items statements;
    for (const Field& member : structure.members) {
      const std::string put = is_flags(member.type) ? "to.put_flags(" : "to.put(";
      statements.push_back(put + "value." + names_.member(member.name) + ");");
    }
    if (statements.size() == 1) return short_function(0, head, statements.front());
    std::string text = function(0, head);
    for (const std::string& statement : statements) text += "  " + statement + "\n";
    return text + "}\n";
  }

  std::string decoder(const Structure& structure) const {
    const Function head{"inline bool",
                        "",
                        "decode",
                        {"armature::ride::Decoder& from", names_.type(structure.name) + "& value"},
                        " {"};
    Items checks;
    for (const Field& member : structure.members) {
      const std::string take = is_flags(member.type) ? "from.take_flags(" : "from.take(";
      checks.push_back(take + "value." + names_.member(member.name) + ")");
    }
    for (const Field& member : structure.members) {
      if (member.range) checks.push_back("from.within(" + ranged(member) + ", value)");
    }
    return returning(head, checks);
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
    const Function head{
        "inline bool", "", "in_range", {"const " + names_.type(structure.name) + "& value"}, " {"};
    return returning(head, checks);
  }

  std::string event_number(const Structure& structure) const {
    if (!structure.is_event) return {};
    const std::string number = hexadecimal(number_of(canonical(text_.program(), structure)));
    const Function head{"constexpr armature::ride::Number",
                        "",
                        "event_number",
                        {"const " + names_.type(structure.name) + "*"},
                        " {"};
    return short_function(0, head, "return " + number + ";");
  }

  /// A function that returns whether all is true.
  static std::string returning(const Function& head, const Items& checks) {
    const std::string statement = chain(2, "return ", checks, "&&", ";");
    const bool one_line = statement.find('\n') + 1 == statement.size();
    if (one_line) return short_function(0, head, statement.substr(2, statement.size() - 3));
    return function(0, head) + statement + "}\n";
  }

  std::string written(const Interface& interface) const {
    const std::string constant = names_.constant(interface);
    const std::string number = hexadecimal(digest(text_.program(), interface));
    std::string text = comment(0, {"What interface " + interface.name +
                                   " has; both sides compare its digest, " + number + "."});
    text += "inline constexpr armature::ride::Declaration " + constant + "Declarations[] = {\n";
    for (const Operation& operation : interface.operations) {
      text += declaration(canonical(text_.program(), operation), operation.access);
    }
    for (const EventName& event : interface.events) {
      const Structure& structure = *text_.program().find_event(event.name);
      text += declaration(canonical(text_.program(), structure), Access::kRead);
    }
    return text + "};\n" +
           call(0, "inline constexpr armature::ride::Interface " + constant + "{",
                {literal(interface.name), constant + "Declarations"}, "};");
  }

  static std::string declaration(const std::string& canonical, Access access) {
    std::string name(name_of(access));
    name.front() = static_cast<char>(name.front() - 'a' + 'A');
    const std::string behind = "armature::ride::Access::k" + name + "},\n";
    const std::string line = "    {" + literal(canonical) + ", " + behind;
    if (base::columns_of(line) <= kColumns + 1) return line;
    return "    {" + long_literal(5, canonical) + ",\n     " + behind;
  }

  const CppText& text_;
  const CppNames& names_;
};

}  // namespace

std::string write_types(const CppText& text) { return TypesWriter(text).run(); }

}  // namespace armature::idl::internal
