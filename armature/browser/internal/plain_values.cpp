// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/plain_values.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "armature/browser/internal/display.hpp"
#include "armature/browser/internal/words.hpp"

namespace armature::browser::internal {
namespace {

using remote::FieldDetails;

struct Mistake {
  std::string text;
};

/// Of lists and structs in one another.
constexpr int kDeepest = 64;

std::string excerpt(std::string_view text) {
  constexpr std::size_t kLongest = 30;
  if (text.empty()) return "the end of the line";
  return "'" + std::string(text.substr(0, kLongest)) + (text.size() > kLongest ? "..." : "") + "'";
}

/// Reads what an operator types, from its beginning to its end.
class TypedReader {
 public:
  explicit TypedReader(std::string_view text) : rest_(text) {}

  /// @param inside  of a list or struct, where texts are in quotes
  std::string value(bool inside) {
    if (++depth_ > kDeepest) throw Mistake{"lists and structs are nested too deep"};
    std::string text = one_value(inside);
    --depth_;
    return text;
  }

  std::vector<std::string> arguments() {
    std::vector<std::string> all;
    skip_blanks();
    if (take_if(')')) return all;
    do {
      all.push_back(value(false));
      skip_blanks();
    } while (take_if(','));
    expect(')');
    return all;
  }

  void expect_end() {
    skip_blanks();
    if (!rest_.empty()) throw Mistake{"expected the end of the line, found " + excerpt(rest_)};
  }

 private:
  std::string one_value(bool inside) {
    skip_blanks();
    if (starts_with('"') || starts_with('\'')) return quoted(inside);
    if (take("array")) {
      skip_blanks();
      expect('(');
      return elements(')');
    }
    if (take_if('[')) return elements(']');
    if (take_if('{')) return table();
    return word();
  }

  void skip_blanks() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t'))
      rest_.remove_prefix(1);
  }
  bool starts_with(char c) const { return !rest_.empty() && rest_.front() == c; }
  bool take_if(char c) {
    if (!starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }
  bool take(std::string_view name) {
    const bool there = rest_.starts_with(name) &&
                       (rest_.size() == name.size() || !is_name_character(rest_[name.size()]));
    if (there) rest_.remove_prefix(name.size());
    return there;
  }
  void expect(char c) {
    if (!take_if(c)) throw Mistake{std::string("expected '") + c + "', found " + excerpt(rest_)};
  }

  /// Behind the opening bracket.
  std::string elements(char end) {
    std::string text = "[";
    skip_blanks();
    if (take_if(end)) return "[]";
    do {
      text += (text.size() > 1 ? ", " : "") + value(true);
      skip_blanks();
    } while (take_if(','));
    expect(end);
    return text + "]";
  }

  /// A struct if its first element has a name, else a list.
  std::string table() {
    skip_blanks();
    std::size_t size = 0;
    while (size < rest_.size() && is_name_character(rest_[size])) ++size;
    std::size_t next = size;
    while (next < rest_.size() && rest_[next] == ' ') ++next;
    const bool named = size > 0 && is_letter(rest_.front()) && next < rest_.size() &&
                       (rest_[next] == '=' || rest_[next] == ':');
    return named ? members() : elements('}');
  }

  std::string members() {
    std::string text = "{";
    do {
      skip_blanks();
      text += (text.size() > 1 ? ", " : "") + word();
      skip_blanks();
      if (!take_if('=')) expect(':');
      text += ": " + value(true);
      skip_blanks();
    } while (take_if(','));
    expect('}');
    return text + "}";
  }

  std::string word() {
    const std::size_t size = std::min(rest_.find_first_of(" \t,()[]{}=:\"'"), rest_.size());
    if (size == 0) throw Mistake{"expected a value, found " + excerpt(rest_)};
    const std::string text(rest_.substr(0, size));
    rest_.remove_prefix(size);
    return text;
  }

  std::string quoted(bool inside) {
    const char quote = rest_.front();
    rest_.remove_prefix(1);
    std::string text;
    while (!rest_.empty() && rest_.front() != quote) {
      char c = rest_.front();
      rest_.remove_prefix(1);
      if (c == '\\' && !rest_.empty()) {
        c = rest_.front() == 'n' ? '\n' : rest_.front() == 't' ? '\t' : rest_.front();
        rest_.remove_prefix(1);
      }
      text += c;
    }
    if (!take_if(quote)) throw Mistake{std::string("a text has no closing ") + quote};
    return inside ? in_quotes(text) : text;
  }

  std::string_view rest_;
  int depth_ = 0;
};

/// Writes a value of another process for people.
class Shortener {
 public:
  Shortener(const std::vector<FieldDetails>& fields, std::size_t most_elements)
      : fields_(fields), most_elements_(most_elements) {}

  std::string value(std::string_view& rest, const std::string& type, int depth = 0) const {
    const bool too_deep = depth > kDeepest;  // no type is; it is not to cost this process its stack
    if (rest.starts_with('[') && !too_deep) return list(rest, element_of(type), depth + 1);
    if (rest.starts_with('{') && !too_deep) return structure(rest, type, depth + 1);
    if (rest.starts_with('"')) return text(rest);
    const std::size_t size = std::min(rest.find_first_of(",]}"), rest.size());
    const std::string word(rest.substr(0, size));
    rest.remove_prefix(size);
    return number(word, type);
  }

 private:
  /// `double` of `vector<double>` and of `array<double,2>`.
  static std::string element_of(const std::string& type) {
    const std::size_t begin = type.find('<');
    if (begin == std::string::npos) return {};
    const bool counted = type.starts_with("array");
    const std::size_t end = counted ? type.rfind(',') : type.rfind('>');
    return end == std::string::npos || end <= begin ? "" : type.substr(begin + 1, end - begin - 1);
  }

  /// The digits that are worth reading.
  static std::string number(const std::string& word, const std::string& type) {
    double number = 0.0;
    const char* const end = word.data() + word.size();
    const bool real = type == "double" || type == "float";
    if (!real || std::from_chars(word.data(), end, number).ptr != end) return word;
    char text[40];
    std::snprintf(text, sizeof text, "%.*g", type == "float" ? 6 : 9, number);
    return text;
  }

  static void skip(std::string_view& rest, std::string_view what) {
    while (!rest.empty() && what.find(rest.front()) != std::string_view::npos)
      rest.remove_prefix(1);
  }

  std::string list(std::string_view& rest, const std::string& element, int depth) const {
    rest.remove_prefix(1);
    std::string text = "[";
    std::size_t count = 0;
    while (!rest.empty() && rest.front() != ']') {
      const std::size_t before = rest.size();
      const std::string one = value(rest, element, depth);
      if (count++ < most_elements_) text += (text.size() > 1 ? ", " : "") + one;
      skip(rest, ", ");
      if (rest.size() == before) break;
    }
    if (!rest.empty()) rest.remove_prefix(1);
    if (count > most_elements_) text += ", ... " + std::to_string(count) + " elements";
    return text + "]";
  }

  std::string structure(std::string_view& rest, const std::string& type, int depth) const {
    rest.remove_prefix(1);
    std::string text = "{";
    while (!rest.empty() && rest.front() != '}') {
      const std::size_t before = rest.size();
      const std::string name(rest.substr(0, std::min(rest.find(':'), rest.size())));
      rest.remove_prefix(std::min(name.size() + 1, rest.size()));
      skip(rest, " ");
      const FieldDetails* const field = find(type, name);
      text += (text.size() > 1 ? ", " : "") + name + ": " +
              with_unit(value(rest, field == nullptr ? "" : field->type, depth),
                        field == nullptr ? "" : field->unit);
      skip(rest, ", ");
      if (rest.size() == before) break;
    }
    if (!rest.empty()) rest.remove_prefix(1);
    return text + "}";
  }

  /// With its quotes and what is escaped in it.
  static std::string text(std::string_view& rest) {
    std::size_t end = 1;
    while (end < rest.size() && rest[end] != '"') end += rest[end] == '\\' ? 2 : 1;
    end = std::min(end + 1, rest.size());
    const std::string whole(rest.substr(0, end));
    rest.remove_prefix(end);
    return whole;
  }

  const FieldDetails* find(const std::string& structure, const std::string& name) const {
    const auto found = std::find_if(fields_.begin(), fields_.end(), [&](const FieldDetails& one) {
      return one.structure == structure && one.name == name;
    });
    return found == fields_.end() ? nullptr : &*found;
  }

  const std::vector<FieldDetails>& fields_;
  std::size_t most_elements_;
};

}  // namespace

base::Result<std::string> as_in_files(std::string_view typed) {
  const std::string text = trimmed(typed);
  const bool plain = text.find_first_of("\"'[{(") == std::string::npos;
  if (plain) return text;
  try {
    TypedReader reader(text);
    std::string value = reader.value(false);
    reader.expect_end();
    return value;
  } catch (const Mistake& mistake) {
    return base::Error{mistake.text};
  }
}

bool is_call(std::string_view line) {
  const std::size_t bracket = line.find('(');
  if (bracket == std::string_view::npos) return false;
  const std::string_view head = line.substr(0, bracket);
  const std::size_t colon = head.rfind(':');
  return colon != std::string_view::npos && colon > 0 &&
         head.find_first_of(" =\"'") == std::string_view::npos;
}

base::Result<TypedCall> parse_call(std::string_view line) {
  const std::size_t bracket = line.find('(');
  const std::size_t colon = line.substr(0, bracket).rfind(':');
  TypedCall call{std::string(line.substr(0, colon)),
                 std::string(line.substr(colon + 1, bracket - colon - 1)),
                 {}};
  try {
    TypedReader reader(line.substr(bracket + 1));
    call.arguments = reader.arguments();
    reader.expect_end();
    return call;
  } catch (const Mistake& mistake) {
    return base::Error{call.component + "." + call.operation + ": " + mistake.text};
  }
}

std::string for_people(std::string_view text, const std::string& type,
                       const std::vector<FieldDetails>& fields, std::size_t most_elements) {
  const bool is_text = type == "text" || type.starts_with("text<");
  if (is_text) return in_quotes(text);
  return Shortener(fields, most_elements).value(text, type);
}

std::string harmless(std::string_view text) {
  std::string safe;
  bool continued = false;  // the second byte of U+0080 to U+009F, which are control characters too
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    const bool moves =
        (code < 0x20 && c != '\n' && c != '\t') || code == 0x7f || (continued && code < 0xa0);
    continued = code == 0xc2;
    safe += moves ? '?' : c;
  }
  return safe;
}

}  // namespace armature::browser::internal
