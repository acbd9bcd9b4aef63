// SPDX-License-Identifier: Apache-2.0
#include "idl/internal/type_parser.hpp"

#include <charconv>
#include <optional>

#include "armature/base/near_name.hpp"
#include "idl/internal/in_quotes.hpp"
#include "idl/limits.hpp"

namespace armature::idl::internal {
namespace {

/// Types that are one word.
constexpr Basic kWords[] = {Basic::kBool, Basic::kChar,  Basic::kByte,   Basic::kShort, Basic::kInt,
                            Basic::kLong, Basic::kFloat, Basic::kDouble, Basic::kString};

struct Foreign {
  std::string_view name;
  std::string_view ours;
};
constexpr Foreign kForeign[] = {{"boolean", "bool"},    {"octet", "byte"},
                                {"int8_t", "char"},     {"uint8_t", "byte"},
                                {"int16_t", "short"},   {"uint16_t", "unsigned short"},
                                {"int32_t", "int"},     {"uint32_t", "unsigned int"},
                                {"int64_t", "long"},    {"uint64_t", "unsigned long"},
                                {"float32", "float"},   {"float64", "double"},
                                {"vector", "Array<T>"}, {"sequence", "Array<T>"},
                                {"list", "Array<T>"},   {"std", "String or Array<T>"}};

std::optional<Basic> basic_type(const Token& token) {
  for (const Basic basic : kWords) {
    if (TokenReader::is(token, name_of(basic))) return basic;
  }
  return std::nullopt;
}

std::vector<std::string> defined(const std::vector<Token>& tokens, std::string_view kind) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i + 2 < tokens.size(); ++i) {
    const Token& behind = tokens[i + 2];
    const bool begins = TokenReader::is(behind, "{") || TokenReader::is(behind, ":");
    if (begins && TokenReader::is(tokens[i], kind)) names.emplace_back(tokens[i + 1].text);
  }
  return names;
}

}  // namespace

TypeParser::TypeParser(TokenReader& reader)
    : reader_(reader),
      structs_(defined(reader.all(), "struct")),
      enums_(defined(reader.all(), "enum")) {}

Basic TypeParser::parse_underlying(const std::string& of_what) {
  const Token& first = reader_.now();
  const Type type = parse(of_what);
  const bool holds = is_whole_number(type.basic) && type.basic != Basic::kUnsignedLong;
  if (holds && !type.is_array()) return type.basic;
  reader_.error(first,
                "expected an integer type for " + of_what +
                    ": char, byte, short, unsigned short, int, unsigned int or long; found " +
                    in_quotes(to_text(type)));
  return Basic::kLong;
}

Type TypeParser::parse_or_void(const std::string& of_what) {
  if (!reader_.is("void")) return parse(of_what);
  Type type;
  type.where = reader_.where(reader_.take());
  return type;
}

Type TypeParser::parse(const std::string& of_what) {
  return reader_.is("Array") ? array() : single(of_what);
}

Type TypeParser::array() {
  const base::Location where = reader_.where(reader_.take());
  reader_.expect("<", "'Array'");
  if (reader_.is("Array")) {
    reader_.fail(reader_.now(), "an array holds single values; found an array in an array",
                 "put the inner one into a struct: it is the same on the wire");
  }
  Type type = single("the array's elements");
  type.where = where;
  type.form = Type::Form::kCounted;
  if (reader_.take_if(",")) {
    type.form = Type::Form::kFixed;
    type.count = element_count();
  }
  reader_.expect(">", "the elements of the array");
  return type;
}

std::uint32_t TypeParser::element_count() {
  const Token& token = reader_.now();
  std::uint32_t count = 0;
  const char* const end = token.text.data() + token.text.size();
  const auto parsed = std::from_chars(token.text.data(), end, count);
  const bool whole = token.kind == Token::Kind::kNumber && parsed.ec == std::errc() &&
                     parsed.ptr == end && count >= 1 && count <= kMostElements;
  if (!whole) {
    reader_.fail(token, "expected the number of elements, 1 to " + std::to_string(kMostElements) +
                            ", found " + TokenReader::shown(token));
  }
  reader_.take();
  return count;
}

Type TypeParser::single(const std::string& of_what) {
  Type type;
  type.where = reader_.where(reader_.now());
  if (reader_.take_if("unsigned")) {
    type.basic = unsigned_type();
  } else if (reader_.take_if("struct")) {
    type.basic = Basic::kStruct;
    type.name = reader_.expect_name("a struct").text;
  } else if (reader_.take_if("enum")) {
    type.basic = Basic::kEnum;
    type.name = reader_.expect_name("an enum").text;
  } else if (const auto basic = basic_type(reader_.now())) {
    type.basic = *basic;
    reader_.take();
  } else {
    type = unknown(of_what);
  }
  return type;
}

Basic TypeParser::unsigned_type() {
  if (reader_.take_if("short")) return Basic::kUnsignedShort;
  if (reader_.take_if("int")) return Basic::kUnsignedInt;
  if (reader_.take_if("long")) return Basic::kUnsignedLong;
  reader_.fail(reader_.now(),
               "expected 'short', 'int' or 'long' after 'unsigned', found " +
                   TokenReader::shown(reader_.now()),
               reader_.is("char") ? "an unsigned char is a 'byte'" : "");
}

Type TypeParser::unknown(const std::string& of_what) {
  const Token& token = reader_.now();
  if (reader_.is("void")) {
    reader_.fail(token,
                 "'void' is only the result of an operation; expected the type of " + of_what);
  }
  if (token.kind != Token::Kind::kWord || is_word_of_the_language(token.text)) {
    reader_.fail(token, "expected the type of " + of_what + ", found " + TokenReader::shown(token));
  }
  base::Hint hint;
  std::vector<std::string> known(structs_);
  known.insert(known.end(), enums_.begin(), enums_.end());
  for (const Basic basic : kWords) known.emplace_back(name_of(basic));
  for (const Foreign& foreign : kForeign) {
    if (token.text == foreign.name) hint = "write " + std::string(foreign.ours);
  }
  for (const std::string& name : structs_) {
    if (token.text == name) hint = "write 'struct " + name + "'";
  }
  for (const std::string& name : enums_) {
    if (token.text == name) hint = "write 'enum " + name + "'";
  }
  if (hint.empty()) hint = base::suggestion(token.text, known);
  reader_.error(token,
                "unknown type " + TokenReader::shown(token) + "; expected the type of " + of_what,
                hint);
  const Token& after = reader_.ahead(1);
  const bool plausible = after.kind == Token::Kind::kWord || TokenReader::is(after, ",") ||
                         TokenReader::is(after, ")") || TokenReader::is(after, ">");
  if (!plausible) throw Mistake{};
  reader_.take();
  Type type;
  type.basic = Basic::kInt;
  return type;
}

}  // namespace armature::idl::internal
