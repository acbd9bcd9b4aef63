// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <cstring>
#include <limits>

#include "armature/record/internal/json_text.hpp"
#include "armature/record/json.hpp"
#include "armature/types/enum.hpp"

namespace armature::record {
namespace {

using types::Field;
using types::Kind;
using types::Type;

class JsonReader {
 public:
  explicit JsonReader(std::string_view text) : text_(text), rest_(text) {}

  bool read_whole(const Type& type, void* value) {
    const bool read_it =
        type.kind == Kind::kStruct ? read(type, value) : read_value_member(type, value);
    return read_it && (rest_.empty() || fail("the end"));
  }

  std::string problem() const {
    return "expected " + expected_ + " at byte " + std::to_string(text_.size() - rest_.size());
  }

 private:
  bool read(const Type& type, void* value) {
    if (types::is_text(type)) return read_text(type, value);
    if (type.kind == Kind::kArray) return read_array(type, value);
    if (type.kind == Kind::kVector) return read_vector(type, value);
    if (type.kind == Kind::kStruct) return read_struct(type, value);
    if (type.kind == Kind::kEnum) return read_enumerator(type, value);
    return read_scalar(type, value);
  }

  bool read_value_member(const Type& type, void* value) {
    return expect("{") && read_name(internal::kValueMember) && read(type, value) && expect("}");
  }

  bool read_struct(const Type& type, void* value) {
    if (!expect("{")) return false;
    for (const Field& field : type.fields) {
      if (&field != &type.fields.front() && !expect(",")) return false;
      if (!read_name(field.name)) return false;
      if (!read(*field.type, types::at_offset(value, field.offset))) return false;
    }
    return expect("}");
  }

  bool read_name(std::string_view name) { return expect('"' + std::string(name) + "\":"); }

  bool read_array(const Type& type, void* value) {
    if (!expect("[")) return false;
    for (std::size_t i = 0; i < type.count; ++i) {
      if (i > 0 && !expect(",")) return false;
      if (!read_element(type, value, i)) return false;
    }
    return expect("]");
  }

  bool read_vector(const Type& type, void* value) {
    type.vector_resize(value, 0);
    if (!expect("[")) return false;
    if (take("]")) return true;
    std::size_t count = 0;
    do {
      type.vector_resize(value, count + 1);
      if (!read_element(type, type.vector_data(value), count++)) return false;
    } while (take(","));
    return expect("]");
  }

  bool read_element(const Type& list, void* first, std::size_t index) {
    return read(*list.element, static_cast<std::byte*>(first) + index * list.element->size);
  }

  bool read_text(const Type& type, void* value) {
    if (!expect("\"")) return false;
    std::string text;
    while (!rest_.empty() && rest_.front() != '"') {
      if (take("\\")) {
        if (!read_escape(text)) return false;
      } else {
        text += rest_.front();
        rest_.remove_prefix(1);
      }
    }
    if (type.kind == Kind::kFixedText && text.size() > type.count) {
      return fail("a text of at most " + std::to_string(type.count) + " bytes");
    }
    if (!expect("\"")) return false;
    type.set_text(value, text);
    return true;
  }

  bool read_enumerator(const Type& type, void* value) {
    for (const types::Enumerator& each : type.enumerators) {
      if (!take('"' + each.name + '"')) continue;
      types::set_enumerator(type, each, value);
      return true;
    }
    return fail(types::enumerator_list(type));
  }

  bool read_escape(std::string& to) {
    if (take("u00")) return read_control_character(to);
    if (rest_.empty() || (rest_.front() != '"' && rest_.front() != '\\')) {
      return fail("an escaped character");
    }
    to += rest_.front();
    rest_.remove_prefix(1);
    return true;
  }

  bool read_control_character(std::string& to) {
    unsigned char byte = 0;
    const char* const begin = rest_.data();
    if (rest_.size() < 2 || std::from_chars(begin, begin + 2, byte, 16).ptr != begin + 2) {
      return fail("two hexadecimal digits");
    }
    to += static_cast<char>(byte);
    rest_.remove_prefix(2);
    return true;
  }

  bool read_scalar(const Type& type, void* value) {
    return types::with_scalar(type.kind, [&](auto of) {
      using T = typename decltype(of)::type;
      if constexpr (std::is_same_v<T, bool>) {
        return read_bool(value);
      } else if constexpr (std::is_floating_point_v<T>) {
        return read_float<T>(type, value);
      } else {
        return read_number<T>(type, value);
      }
    });
  }

  bool read_bool(void* value) {
    const bool yes = take("true");
    if (!yes && !take("false")) return fail("true or false");
    *static_cast<bool*>(value) = yes;
    return true;
  }

  template <typename T>
  bool read_float(const Type& type, void* value) {
    using Limits = std::numeric_limits<T>;
    if (take("null")) return store(Limits::quiet_NaN(), value);
    if (take(internal::kInfinity)) return store(Limits::infinity(), value);
    if (take("-" + std::string(internal::kInfinity))) return store(-Limits::infinity(), value);
    return read_number<T>(type, value);
  }

  template <typename T>
  bool read_number(const Type& type, void* value) {
    const std::string_view digits = rest_.substr(0, rest_.find_first_not_of("0123456789+-.e"));
    const char* const end = digits.data() + digits.size();
    T number{};
    const auto [stopped, problem] = std::from_chars(digits.data(), end, number);
    if (problem != std::errc() || stopped != end) return fail("a number of " + type.name);
    rest_.remove_prefix(digits.size());
    return store(number, value);
  }

  template <typename T>
  bool store(T number, void* value) {
    std::memcpy(value, &number, sizeof number);
    return true;
  }

  bool take(std::string_view wanted) {
    if (!rest_.starts_with(wanted)) return false;
    rest_.remove_prefix(wanted.size());
    return true;
  }

  bool expect(std::string_view wanted) {
    return take(wanted) || fail("'" + std::string(wanted) + "'");
  }

  bool fail(std::string expected) {
    expected_ = std::move(expected);
    return false;
  }

  std::string_view text_;
  std::string_view rest_;
  std::string expected_;
};

}  // namespace

base::Result<void> from_json(const Type& type, std::string_view json, void* value) {
  JsonReader reader(json);
  types::Value read(type);
  if (!reader.read_whole(type, read.data())) {
    return base::Error{"cannot read " + type.name + " from JSON: " + reader.problem()};
  }
  type.assign(value, read.data());
  return {};
}

}  // namespace armature::record
