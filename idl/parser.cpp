// SPDX-License-Identifier: Apache-2.0
#include "idl/parser.hpp"

#include <utility>

#include "armature/base/near_name.hpp"
#include "idl/internal/attribute_parser.hpp"
#include "idl/internal/in_quotes.hpp"
#include "idl/internal/token_reader.hpp"
#include "idl/internal/type_parser.hpp"
#include "idl/number.hpp"

namespace armature::idl {
namespace {

using internal::Attributes;
using internal::Mistake;
using internal::TokenReader;

class Parser {
 public:
  Parser(const Source& source, base::Diagnostics& diagnostics)
      : reader_(source, diagnostics), types_(reader_) {
    module_.file = source.file();
  }

  Module run() {
    while (!reader_.at_end() && !reader_.gave_up()) {
      const std::size_t begin = reader_.position();
      try {
        definition();
      } catch (const Mistake&) {
        module_.complete = false;
        skip_definition(begin);
      }
    }
    return std::move(module_);
  }

 private:
  void definition() {
    if (reader_.is("import")) return import();
    if (reader_.is("struct") || reader_.is("event")) return structure();
    if (reader_.is("enum")) return enumeration();
    if (reader_.is("interface")) return interface();
    const Token& found = reader_.now();
    const std::string near =
        base::near_name(found.text, {"struct", "enum", "event", "interface", "import"});
    reader_.fail(found,
                 "expected 'struct', 'enum', 'event', 'interface' or 'import', found " +
                     TokenReader::shown(found),
                 near.empty() ? "" : "did you mean '" + near + "'?");
  }

  void import() {
    reader_.take();
    const Token& path = reader_.now();
    if (path.kind != Token::Kind::kText) {
      reader_.fail(path, "expected the file to import, as in import \"other.idl\";, found " +
                             TokenReader::shown(path));
    }
    module_.imports.push_back({std::string(path.text), reader_.where(path), {}});
    reader_.take();
    reader_.expect(";", "the imported file");
  }

  void structure() {
    const std::size_t begin = reader_.position();
    Structure result;
    result.is_event = reader_.is("event");
    const std::string kind(reader_.take().text);
    const Token& name = reader_.expect_name("the " + kind);
    result.name = name.text;
    result.where = reader_.where(name);
    reader_.expect("{", "the name of the " + kind);
    result.doc = reader_.doc_between(begin, reader_.position());
    const std::string whole = kind + " " + in_quotes(result.name);
    const bool closed = in_braces(whole, [&] { result.members.push_back(member(whole)); });
    result.complete = !lost_;
    module_.structures.push_back(std::move(result));
    if (!closed) throw Mistake{};
  }

  void enumeration() {
    const std::size_t begin = reader_.position();
    Enumeration result;
    reader_.take();
    const Token& name = reader_.expect_name("the enum");
    result.name = name.text;
    result.where = reader_.where(name);
    const std::string whole = "enum " + in_quotes(result.name);
    if (reader_.take_if(":")) result.underlying = types_.parse_underlying(whole);
    reader_.expect("{", "the name of the enum");
    result.doc = reader_.doc_between(begin, reader_.position());
    do {
      result.enumerators.push_back(enumerator(whole, result.enumerators));
    } while (reader_.take_if(",") && !reader_.is("}"));
    if (!reader_.is("}")) {
      reader_.fail(reader_.now(), "expected ',' or '}' after enumerator " +
                                      in_quotes(result.enumerators.back().name) + ", found " +
                                      TokenReader::shown(reader_.now()));
    }
    reader_.take();
    reader_.take_if(";");
    module_.enumerations.push_back(std::move(result));
  }

  /// Without a number it is one more than the one before.
  Enumerator enumerator(const std::string& whole, const std::vector<Enumerator>& before) {
    const std::size_t begin = reader_.position();
    Enumerator result;
    const Token& name = reader_.expect_inner_name("an enumerator of " + whole);
    result.name = name.text;
    result.where = reader_.where(name);
    if (!before.empty()) result.value = next(before.back().value);
    if (reader_.take_if("=")) result.value = value_of(result);
    result.doc = reader_.doc_between(begin, reader_.position());
    add_doc_behind_comma(result.doc);
    return result;
  }

  Whole value_of(const Enumerator& enumerator) {
    const Token& token = reader_.now();
    const auto number = token.kind == Token::Kind::kNumber ? parse_whole(token.text) : std::nullopt;
    if (!number) {
      reader_.fail(token, "expected the value of enumerator " + in_quotes(enumerator.name) +
                              ", a whole number, found " + TokenReader::shown(token));
    }
    reader_.take();
    return *number;
  }

  /// `a,  ///< of a`
  void add_doc_behind_comma(Doc& doc) const {
    const std::string& behind = reader_.now().doc_after;
    if (reader_.is(",") && !behind.empty()) doc.push_back(behind);
  }

  void interface() {
    const std::size_t begin = reader_.position();
    Interface result;
    reader_.take();
    const Token& name = reader_.expect_name("the interface");
    result.name = name.text;
    result.where = reader_.where(name);
    reader_.expect("{", "the name of the interface");
    result.doc = reader_.doc_between(begin, reader_.position());
    const bool closed = in_braces("interface " + in_quotes(result.name), [&] {
      const std::size_t first = reader_.position();
      const Attributes attributes = internal::parse_attributes(reader_);
      if (reader_.is("event")) {
        result.events.push_back(event_name(attributes));
      } else {
        result.operations.push_back(operation(first, attributes));
      }
    });
    result.complete = !lost_;
    module_.interfaces.push_back(std::move(result));
    if (!closed) throw Mistake{};
  }

  /// Declarations until the closing brace; goes on behind each mistake. False if it is missing.
  template <typename Declaration>
  bool in_braces(const std::string& whole, Declaration&& declaration) {
    lost_ = false;
    while (!reader_.is("}")) {
      if (reader_.at_end() || (begins_definition() && !reader_.is("event"))) {
        reader_.error(reader_.now(), "expected '}' at the end of " + whole + ", found " +
                                         TokenReader::shown(reader_.now()));
        return false;
      }
      if (reader_.gave_up()) return false;
      try {
        declaration();
      } catch (const Mistake&) {
        lost_ = true;
        skip_declaration();
      }
    }
    reader_.take();
    reader_.take_if(";");
    return true;
  }

  Field member(const std::string& whole) {
    const std::size_t begin = reader_.position();
    Field result = field("a member of " + whole);
    const Token& name = reader_.expect_inner_name("a member of " + whole);
    result.name = name.text;
    result.where = reader_.where(name);
    reader_.expect(";", "member " + in_quotes(result.name));
    result.doc = reader_.doc_between(begin, reader_.position());
    return result;
  }

  /// Attributes and type of a member or parameter.
  Field field(const std::string& what) {
    Attributes attributes = internal::parse_attributes(reader_);
    for (const Token* const foreign : {attributes.of_operation, attributes.of_message}) {
      if (foreign == nullptr) continue;
      reader_.error(*foreign, TokenReader::shown(*foreign) + " belongs to an operation; " + what +
                                  " has only 'unit' and 'range'");
    }
    Field result;
    result.type = types_.parse(what);
    result.where = result.type.where;
    result.unit = std::move(attributes.unit);
    result.range = std::move(attributes.range);
    return result;
  }

  EventName event_name(const Attributes& attributes) {
    for (const Token* const foreign : {attributes.of_operation, attributes.of_field}) {
      if (foreign == nullptr) continue;
      reader_.error(*foreign, TokenReader::shown(*foreign) +
                                  " does not belong to an event; it has only 'priority'");
    }
    reader_.take();
    const Token& name = reader_.expect_name("an event");
    if (reader_.is("{")) {
      reader_.fail(name, "event " + in_quotes(name.text) + " is defined inside an interface",
                   "define it before the interface; here is only its name, 'event " +
                       std::string(name.text) + ";'");
    }
    reader_.expect(";", "event " + in_quotes(name.text));
    return {std::string(name.text), attributes.priority.value_or(0), reader_.where(name)};
  }

  /// @param begin  where its attributes do
  Operation operation(std::size_t begin, const Attributes& attributes) {
    if (attributes.of_field != nullptr) {
      reader_.error(*attributes.of_field, TokenReader::shown(*attributes.of_field) +
                                              " belongs to a member or parameter; an operation has"
                                              " only 'access', 'priority' and 'later'");
    }
    Operation result;
    result.access = attributes.access.value_or(Access::kCommand);
    result.priority = attributes.priority.value_or(0);
    result.later = attributes.later != nullptr;
    result.result = types_.parse_or_void("an operation's result");
    if (result.later && result.is_command()) {
      reader_.error(*attributes.later, "'later' says when a result comes; a command has none",
                    "leave it out, or give the operation a result");
    }
    const Token& name = reader_.expect_inner_name("an operation");
    result.name = name.text;
    result.where = reader_.where(name);
    result.doc = reader_.doc_between(begin, reader_.position());
    parameters(result);
    return result;
  }

  void parameters(Operation& operation) {
    const std::string what = "a parameter of " + in_quotes(operation.name);
    reader_.expect("(", "operation " + in_quotes(operation.name));
    try {
      if (!reader_.is(")")) {
        do {
          operation.parameters.push_back(parameter(what));
        } while (reader_.take_if(","));
      }
      if (!reader_.is(")")) reader_.expect(")", "the parameters of " + in_quotes(operation.name));
    } catch (const Mistake&) {
      skip_parameters();
      throw;
    }
    const std::size_t end = reader_.position();
    reader_.take();
    // As printed in the paper, the semicolon may be one of the notation or one of the language.
    reader_.take_if(";");
    const Doc behind = reader_.doc_between(end, reader_.position());
    operation.doc.insert(operation.doc.end(), behind.begin(), behind.end());
  }

  Field parameter(const std::string& what) {
    const std::size_t begin = reader_.position();
    Field result = field(what);
    if (reader_.now().kind == Token::Kind::kWord) {
      const Token& name = reader_.expect_inner_name(what);
      result.name = name.text;
      result.where = reader_.where(name);
    }
    result.doc = reader_.doc_between(begin, reader_.position());
    add_doc_behind_comma(result.doc);
    return result;
  }

  /// A semicolon between parameters is no end of the operation, unless another one follows.
  void skip_parameters() {
    while (!reader_.at_end() && !reader_.is(")") && !reader_.is("{") && !reader_.is("}")) {
      if (reader_.is(";") && parenthesis_opens_next()) return;
      reader_.take();
    }
  }

  bool parenthesis_opens_next() const {
    for (std::size_t i = 1; reader_.ahead(i).kind != Token::Kind::kEnd; ++i) {
      const Token& token = reader_.ahead(i);
      if (TokenReader::is(token, "(")) return true;
      if (TokenReader::is(token, ")") || TokenReader::is(token, ";")) return false;
      if (TokenReader::is(token, "}")) return false;
    }
    return false;
  }

  /// Until behind the next semicolon, or before what ends or begins something larger.
  void skip_declaration() {
    int depth = 0;
    while (!reader_.at_end()) {
      if (depth == 0 && (begins_definition() || reader_.is("}"))) return;
      if (reader_.is("{")) ++depth;
      if (reader_.is("}")) --depth;
      const bool ends = depth == 0 && reader_.is(";");
      reader_.take();
      if (ends) return;
    }
  }

  /// Until behind the definition that began at `begin`.
  void skip_definition(std::size_t begin) {
    int depth = 0;
    while (!reader_.at_end()) {
      if (depth == 0 && begins_definition() && reader_.position() > begin) return;
      if (reader_.is("{")) ++depth;
      const bool closes = reader_.is("}") && --depth <= 0;
      const bool ends = depth == 0 && reader_.is(";");
      reader_.take();
      if (closes) reader_.take_if(";");
      if (closes || ends) return;
    }
  }

  /// `struct Pose {` and not only its name, which may stand within a definition.
  bool begins_definition() const {
    if (reader_.is("import")) return reader_.ahead(1).kind == Token::Kind::kText;
    if (reader_.is("enum") && TokenReader::is(reader_.ahead(2), ":")) return true;
    const bool word = reader_.is("struct") || reader_.is("enum") || reader_.is("event") ||
                      reader_.is("interface");
    return word && TokenReader::is(reader_.ahead(2), "{");
  }

  TokenReader reader_;
  internal::TypeParser types_;
  Module module_;
  bool lost_ = false;  ///< a declaration of what is read now, to a mistake
};

/// The paper's grammar has no events inside an interface: where no interface of a file names one,
/// each raises all of the file.
void share_events(Module& module) {
  for (const Interface& interface : module.interfaces) {
    if (!interface.events.empty()) return;
  }
  for (Interface& interface : module.interfaces) {
    for (const Structure& structure : module.structures) {
      if (structure.is_event) interface.events.push_back({structure.name, 0, structure.where});
    }
  }
}

}  // namespace

Module parse(const Source& source, base::Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  Module module = Parser(source, diagnostics).run();
  if (diagnostics.error_count() > errors && module.structures.empty()) module.complete = false;
  share_events(module);
  return module;
}

}  // namespace armature::idl
