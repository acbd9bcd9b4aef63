// SPDX-License-Identifier: Apache-2.0
#include "armature/types/internal/text_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>

#include "armature/base/near_name.hpp"
#include "armature/types/elements.hpp"
#include "armature/types/enum.hpp"

namespace armature::types::internal {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

/// The beginning of what a user wrote, short enough for an error message.
std::string excerpt(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  if (text.empty()) return "nothing";
  if (text.size() <= kLongest) return "'" + std::string(text) + "'";
  return "'" + std::string(text.substr(0, kLongest)) + "...'";
}

std::string article(const Type& type) { return type.name.starts_with("int") ? "an " : "a "; }

}  // namespace

bool TextReader::read_whole(const Type& type, void* value) {
  if (is_text(type)) return set_text(type, rest_, value);
  if (!read(type, value)) return false;
  skip_space();
  return rest_.empty() || fail("unexpected " + excerpt(rest_) + " after the value");
}

bool TextReader::read(const Type& type, void* value) {
  skip_space();
  if (is_text(type)) return read_quoted(type, value);
  if (is_list(type)) return read_list(type, value);
  if (type.kind == Kind::kStruct) return read_struct(type, value);
  return read_scalar(type, value);
}

bool TextReader::read_scalar(const Type& type, void* value) {
  if (type.kind == Kind::kEnum) return read_enumerator(type, value);
  return with_scalar(type.kind, [&](auto of) {
    using T = typename decltype(of)::type;
    if constexpr (std::is_same_v<T, bool>) {
      return read_bool(value);
    } else {
      return read_number<T>(type, value);
    }
  });
}

bool TextReader::read_enumerator(const Type& type, void* value) {
  const std::string_view word = take_word();
  const Enumerator* const found = find_enumerator(type, word);
  if (found == nullptr) {
    const std::string hint = near_enumerator(type, word);
    return fail("expected " + enumerator_list(type) + ", found " +
                excerpt(word.empty() ? rest_ : word) + (hint.empty() ? "" : " (" + hint + ")"));
  }
  if (value != nullptr) set_enumerator(type, *found, value);
  return true;
}

bool TextReader::read_bool(void* value) {
  const std::string_view word = take_word();
  if (word != "true" && word != "false") {
    return fail("expected true or false, found " + excerpt(word.empty() ? rest_ : word));
  }
  if (value != nullptr) *static_cast<bool*>(value) = word == "true";
  return true;
}

template <typename T>
bool TextReader::read_number(const Type& type, void* value) {
  T number{};
  const std::string_view word = take_word();
  const char* const end = word.data() + word.size();
  const auto [stopped, problem] = std::from_chars(word.data(), end, number);
  if (problem == std::errc::result_out_of_range) {
    return fail(excerpt(word) + " is out of the range of " + type.name);
  }
  if (problem != std::errc() || stopped != end) {
    return fail("expected " + article(type) + type.name + ", found " +
                excerpt(word.empty() ? rest_ : word));
  }
  if (value != nullptr) std::memcpy(value, &number, sizeof(number));
  return true;
}

bool TextReader::read_quoted(const Type& type, void* value) {
  if (!take('"')) return fail_expecting("text in double quotes");
  std::string text;
  while (!rest_.empty() && rest_.front() != '"') {
    const char c = rest_.front();
    rest_.remove_prefix(1);
    if (c != '\\') {
      text += c;
    } else if (!read_escape(text)) {
      return false;
    }
  }
  if (!take('"')) return fail("text has no closing quote");
  return set_text(type, text, value);
}

bool TextReader::read_escape(std::string& to) {
  if (take('n')) {
    to += '\n';
  } else if (take('t')) {
    to += '\t';
  } else if (take('"')) {
    to += '"';
  } else if (take('\\')) {
    to += '\\';
  } else {
    unsigned char byte = 0;
    const char* const digits = rest_.data() + 1;
    const bool whole = rest_.size() >= 3 && rest_.front() == 'x' &&
                       std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2;
    if (!whole) return fail("unknown escape '\\" + std::string(rest_.substr(0, 1)) + "' in text");
    to += static_cast<char>(byte);
    rest_.remove_prefix(3);
  }
  return true;
}

bool TextReader::set_text(const Type& type, std::string_view text, void* value) {
  if (type.kind == Kind::kFixedText && text.size() > type.count) {
    return fail("text of " + std::to_string(text.size()) + " bytes does not fit into " + type.name);
  }
  if (value != nullptr) type.set_text(value, text);
  return true;
}

bool TextReader::read_list(const Type& list, void* value) {
  if (!take('[')) return fail_expecting("'[' of " + list.name);
  std::size_t count = 0;
  skip_space();
  if (!take(']')) {
    do {
      if (!read_element(list, value, count++)) return false;
      skip_space();
    } while (take(','));
    if (!take(']')) return fail_expecting("',' or ']'");
  }
  if (list.kind == Kind::kArray && count != list.count) {
    return fail(list.name + " has " + std::to_string(list.count) + " elements, found " +
                std::to_string(count));
  }
  if (list.kind == Kind::kVector && value != nullptr) list.vector_resize(value, count);
  return true;
}

bool TextReader::read_element(const Type& list, void* value, std::size_t index) {
  const bool is_vector = list.kind == Kind::kVector;
  if (!is_vector && index >= list.count) value = nullptr;
  if (is_vector && value != nullptr && list.vector_size(value) <= index) {
    list.vector_resize(value, index + 1);
  }
  void* const first = value == nullptr ? nullptr : elements(list, value);
  const std::size_t outside = path_.size();
  path_ += '[' + std::to_string(index) + ']';
  if (!read(*list.element, at_offset(first, index * list.element->size))) return false;
  path_.resize(outside);
  return true;
}

bool TextReader::read_struct(const Type& type, void* value) {
  if (!take('{')) return fail_expecting("'{' of " + type.name);
  std::vector<char> given(type.fields.size(), false);
  skip_space();
  if (take('}')) return check_complete(type, given);
  do {
    const Field* const field = read_field_name(type);
    if (field == nullptr) return false;
    char& was_given = given[static_cast<std::size_t>(field - type.fields.data())];
    if (was_given) return fail("field '" + std::string(field->name) + "' is given twice");
    was_given = true;
    const std::size_t outside = path_.size();
    if (!path_.empty()) path_ += '.';
    path_ += field->name;
    if (!read(*field->type, at_offset(value, field->offset))) return false;
    path_.resize(outside);
    skip_space();
  } while (take(','));
  if (!take('}')) return fail_expecting("',' or '}'");
  return check_complete(type, given);
}

const Field* TextReader::read_field_name(const Type& type) {
  skip_space();
  const std::string_view name = take_word();
  std::vector<std::string> known;
  for (const Field& field : type.fields) {
    known.emplace_back(field.name);
    if (field.name != name) continue;
    skip_space();
    if (take(':')) return &field;
    fail_expecting("':' after '" + std::string(name) + "'");
    return nullptr;
  }
  if (name.empty()) {
    fail_expecting("the name of a field of " + type.name);
  } else {
    fail(type.name + " has no field '" + std::string(name) + "'" +
         base::suggestion_in_brackets(name, known));
  }
  return nullptr;
}

bool TextReader::check_complete(const Type& type, const std::vector<char>& given) {
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (!given[i]) {
      return fail("field '" + std::string(type.fields[i].name) + "' of " + type.name +
                  " is missing");
    }
  }
  return true;
}

void TextReader::skip_space() {
  rest_.remove_prefix(std::min(rest_.find_first_not_of(kSpace), rest_.size()));
}

bool TextReader::take(char wanted) {
  if (rest_.empty() || rest_.front() != wanted) return false;
  rest_.remove_prefix(1);
  return true;
}

std::string_view TextReader::take_word() {
  const std::string_view word = rest_.substr(0, rest_.find_first_of(" \t\r\n,:[]{}\""));
  rest_.remove_prefix(word.size());
  return word;
}

bool TextReader::fail(const std::string& what) {
  problem_ = path_.empty() ? what : path_ + ": " + what;
  return false;
}

bool TextReader::fail_expecting(const std::string& expected) {
  return fail("expected " + expected + ", found " + excerpt(rest_));
}

}  // namespace armature::types::internal
