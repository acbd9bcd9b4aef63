// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include "armature/record/cdr.hpp"
#include "armature/record/internal/json_text.hpp"
#include "armature/record/internal/layout.hpp"
#include "armature/types/elements.hpp"

namespace armature::record {
namespace {

using internal::Layout;
using types::Kind;

constexpr std::size_t kCdrHeadBytes = 4;

/// Reads CDR by a layout, and writes JSON.
class CdrReader {
 public:
  explicit CdrReader(std::string_view cdr) : whole_(cdr) {}

  bool whole(const Layout& layout) {
    if (!whole_.starts_with(std::string_view("\x00\x01", 2)) || whole_.size() < kCdrHeadBytes) {
      return fail("CDR, little-endian");
    }
    bytes_ = whole_.substr(kCdrHeadBytes);
    const bool structure = layout.kind == Kind::kStruct;
    if (!structure) {
      json_ += '{';
      internal::append_json_string(internal::kValueMember, json_);
      json_ += ':';
    }
    if (!take(layout)) return false;
    if (!structure) json_ += '}';
    return at_ == bytes_.size() || fail("the end");
  }

  std::string take_json() { return std::move(json_); }
  std::string problem() const {
    return "expected " + expected_ + " at byte " + std::to_string(at_ + kCdrHeadBytes);
  }

 private:
  bool fail(const char* expected) {
    expected_ = expected;
    return false;
  }

  bool take(const Layout& layout) {
    switch (layout.kind) {
      case Kind::kStruct:
        return take_struct(layout);
      case Kind::kVector:
      case Kind::kArray:
        return take_list(layout);
      case Kind::kText:
      case Kind::kFixedText:
        return take_text();
      case Kind::kEnum:
        return take_enumerator(layout);
      default:
        return take_scalar(layout.kind, json_);
    }
  }

  template <typename Number>
  bool take_number(Number& number) {
    const std::size_t begin = (at_ + sizeof number - 1) / sizeof number * sizeof number;
    if (begin > bytes_.size() || bytes_.size() - begin < sizeof number) return fail("a number");
    std::memcpy(&number, bytes_.data() + begin, sizeof number);
    at_ = begin + sizeof number;
    return true;
  }

  bool take_scalar(Kind kind, std::string& to) {
    return types::with_scalar(kind, [&](auto of) {
      using T = typename decltype(of)::type;
      if constexpr (std::is_same_v<T, bool>) {
        std::uint8_t byte = 0;
        if (!take_number(byte)) return false;
        if (byte > 1) return fail("0 or 1");
        to += byte == 1 ? "true" : "false";
      } else {
        T number{};
        if (!take_number(number)) return false;
        put_as_json(number, to);
      }
      return true;
    });
  }

  template <typename Number>
  static void put_as_json(Number number, std::string& to) {
    if constexpr (std::is_floating_point_v<Number>) {
      if (std::isnan(number)) {
        to += "null";
        return;
      }
      if (std::isinf(number)) {
        if (number < 0) to += '-';
        to += internal::kInfinity;
        return;
      }
    }
    std::array<char, 32> digits;
    to.append(digits.data(),
              std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
  }

  bool take_text() {
    std::uint32_t size = 0;
    if (!take_number(size)) return false;
    if (size == 0 || size > bytes_.size() - at_ || bytes_[at_ + size - 1] != '\0') {
      return fail("a text that ends with 0");
    }
    internal::append_json_string(bytes_.substr(at_, size - 1), json_);
    at_ += size;
    return true;
  }

  bool take_enumerator(const Layout& layout) {
    std::string number;
    if (!take_scalar(layout.underlying, number)) return false;
    for (const types::Enumerator& one : layout.enumerators) {
      if (std::to_string(one.value) == number) number = one.name;
    }
    internal::append_json_string(number, json_);
    return true;
  }

  bool take_list(const Layout& layout) {
    std::uint32_t count = static_cast<std::uint32_t>(layout.count);
    if (layout.kind == Kind::kVector && !take_number(count)) return false;
    if (count > bytes_.size() - at_) return fail("a list that fits into what is left");
    json_ += '[';
    for (std::uint32_t i = 0; i < count; ++i) {
      if (i > 0) json_ += ',';
      if (!take(layout.parts[0])) return false;
    }
    json_ += ']';
    return true;
  }

  bool take_struct(const Layout& layout) {
    json_ += '{';
    for (const Layout& part : layout.parts) {
      if (&part != &layout.parts.front()) json_ += ',';
      internal::append_json_string(part.field, json_);
      json_ += ':';
      if (!take(part)) return false;
    }
    json_ += '}';
    return true;
  }

  const std::string_view whole_;
  std::string_view bytes_;  ///< behind the head, from where numbers are aligned
  std::size_t at_ = 0;
  std::string json_;
  std::string expected_;
};

}  // namespace

base::Result<std::string> json_of_cdr(std::string_view layout, std::string_view cdr) {
  const auto parsed = internal::parse_layout(layout);
  if (!parsed) return base::Error{"'" + std::string(layout) + "' is no layout of a type"};
  CdrReader reader(cdr);
  if (!reader.whole(*parsed)) return base::Error{reader.problem()};
  return reader.take_json();
}

}  // namespace armature::record
