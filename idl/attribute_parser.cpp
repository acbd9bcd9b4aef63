// SPDX-License-Identifier: Apache-2.0
#include "idl/internal/attribute_parser.hpp"

#include "armature/base/near_name.hpp"
#include "armature/base/utf8.hpp"
#include "idl/limits.hpp"
#include "idl/number.hpp"

namespace armature::idl::internal {
namespace {

class AttributeParser {
 public:
  explicit AttributeParser(TokenReader& reader) : reader_(reader) {}

  Attributes run() {
    while (reader_.take_if("[")) {
      do {
        take_one();
      } while (reader_.take_if(","));
      reader_.expect("]", "the attribute");
    }
    return std::move(found_);
  }

 private:
  void take_one() {
    const Token& name = reader_.now();
    if (name.kind != Token::Kind::kWord) {
      reader_.fail(name,
                   "expected an attribute, 'unit', 'range', 'access', 'priority' or 'later', "
                   "found " +
                       TokenReader::shown(name));
    }
    reader_.take();
    if (name.text == "unit") {
      take_unit(name);
    } else if (name.text == "range") {
      take_range(name);
    } else if (name.text == "access") {
      take_access(name);
    } else if (name.text == "priority") {
      take_priority(name);
    } else if (name.text == "later") {
      take_later(name);
    } else {
      reader_.fail(name, "unknown attribute " + TokenReader::shown(name),
                   base::suggestion(name.text, {"unit", "range", "access", "priority", "later"}));
    }
  }

  void take_unit(const Token& name) {
    refuse_second(name, !found_.unit.empty());
    if (found_.of_field == nullptr) found_.of_field = &name;
    reader_.expect("(", "'unit'");
    const Token& unit = text("a unit such as \"rad/s\"");
    found_.unit = unit.text;
    if (unit.text.empty()) {
      reader_.error(unit, "the unit is empty; expected one such as \"rad/s\"",
                    "leave the attribute out for a plain number");
    } else if (base::columns_of(unit.text) > kLongestUnit) {
      reader_.error(unit, "a unit has at most " + std::to_string(kLongestUnit) + " characters");
    }
    reader_.expect(")", "the unit");
  }

  void take_range(const Token& name) {
    refuse_second(name, found_.range.has_value());
    if (found_.of_field == nullptr) found_.of_field = &name;
    Range range;
    range.where = reader_.where(name);
    reader_.expect("(", "'range'");
    range.low = number("the least value");
    reader_.expect(",", "the least value");
    range.high = number("the greatest value");
    reader_.expect(")", "the greatest value");
    found_.range = std::move(range);
  }

  void take_access(const Token& name) {
    refuse_second(name, found_.access.has_value());
    if (found_.of_operation == nullptr) found_.of_operation = &name;
    reader_.expect("(", "'access'");
    const Token& word = text("\"read\", \"command\" or \"configure\"");
    for (const Access access : {Access::kRead, Access::kCommand, Access::kConfigure}) {
      if (word.text == name_of(access)) found_.access = access;
    }
    if (!found_.access) {
      reader_.error(
          word,
          "expected \"read\", \"command\" or \"configure\", found " + TokenReader::shown(word),
          base::suggestion(word.text, {"read", "command", "configure"}));
      found_.access = Access::kCommand;
    }
    reader_.expect(")", "the access");
  }

  void take_priority(const Token& name) {
    constexpr std::uint64_t kMostUrgent = 255;
    refuse_second(name, found_.priority.has_value());
    if (found_.of_message == nullptr) found_.of_message = &name;
    reader_.expect("(", "'priority'");
    const Token& token = reader_.now();
    const std::string text = number("a priority");
    const auto level = parse_whole(text);
    if (!level || level->negative || level->magnitude > kMostUrgent) {
      reader_.error(token, "expected a priority from 0 to 255, the most urgent, found " +
                               TokenReader::shown(token));
    }
    found_.priority = static_cast<std::uint8_t>(level ? level->magnitude : 0);
    reader_.expect(")", "the priority");
  }

  void take_later(const Token& name) {
    refuse_second(name, found_.later != nullptr);
    if (found_.of_operation == nullptr) found_.of_operation = &name;
    found_.later = &name;
  }

  void refuse_second(const Token& name, bool there_is_one) {
    if (there_is_one) reader_.error(name, TokenReader::shown(name) + " is given twice");
  }

  const Token& text(const std::string& what) {
    const Token& token = reader_.now();
    if (token.kind != Token::Kind::kText) {
      reader_.fail(token, "expected " + what + ", found " + TokenReader::shown(token));
    }
    return reader_.take();
  }

  std::string number(const std::string& what) {
    const Token& token = reader_.now();
    if (token.kind != Token::Kind::kNumber) {
      reader_.fail(token, "expected " + what + ", a number, found " + TokenReader::shown(token));
    }
    return std::string(reader_.take().text);
  }

  TokenReader& reader_;
  Attributes found_;
};

}  // namespace

Attributes parse_attributes(TokenReader& reader) { return AttributeParser(reader).run(); }

}  // namespace armature::idl::internal
