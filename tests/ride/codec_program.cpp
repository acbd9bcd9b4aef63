// SPDX-License-Identifier: Apache-2.0
// Reads bodies in hexadecimal, one a line, and prints of each what it holds as text and the same
// encoded again, or "malformed". differential_test.py compares with its own.
#include <array>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <string>
#include <type_traits>
#include <vector>

#include "armature/ride/codec.hpp"

namespace {

using armature::ride::Body;
using armature::ride::Decoder;
using armature::ride::Encoder;

struct Inner {
  std::int8_t a = 0;
  double b = 0;
  std::string c;
};
struct Everything {
  bool on = false;
  std::int8_t letter = 0;
  std::uint8_t byte = 0;
  std::int16_t i16 = 0;
  std::uint16_t u16 = 0;
  std::int32_t i32 = 0;
  std::uint32_t u32 = 0;
  std::int64_t i64 = 0;
  std::uint64_t u64 = 0;
  float f = 0;
  double d = 0;
  std::string text;
  std::vector<std::int16_t> shorts;
  std::vector<std::uint8_t> flags;
  std::array<std::int32_t, 3> three{};
  std::array<bool, 2> two{};
  Inner inner;
  std::vector<Inner> inners;
  std::vector<std::string> names;
  std::vector<std::vector<float>> table;
};

void encode(Encoder& to, const Inner& inner) {
  to.put(inner.a);
  to.put(inner.b);
  to.put(inner.c);
}
bool decode(Decoder& from, Inner& inner) {
  return from.take(inner.a) && from.take(inner.b) && from.take(inner.c);
}

/// Calls `code` with each field; `flags` is the one that is not what it seems.
template <typename Whole, typename Code>
bool for_each(Whole& all, Code&& code) {
  return code(all.on) && code(all.letter) && code(all.byte) && code(all.i16) && code(all.u16) &&
         code(all.i32) && code(all.u32) && code(all.i64) && code(all.u64) && code(all.f) &&
         code(all.d) && code(all.text) && code(all.shorts) && code.flags(all.flags) &&
         code(all.three) && code(all.two) && code(all.inner) && code(all.inners) &&
         code(all.names) && code(all.table);
}

struct Take {
  Decoder& from;
  template <typename T>
  bool operator()(T& field) {
    return from.take(field);
  }
  bool flags(std::vector<std::uint8_t>& field) { return from.take_flags(field); }
};

struct Put {
  Encoder& to;
  template <typename T>
  bool operator()(const T& field) {
    to.put(field);
    return true;
  }
  bool flags(const std::vector<std::uint8_t>& field) {
    to.put_flags(field);
    return true;
  }
};

struct Print {
  std::string text;

  template <typename T>
  bool operator()(const T& field) {
    print(field);
    text += ' ';
    return true;
  }
  bool flags(const std::vector<std::uint8_t>& field) { return (*this)(field); }

  template <typename T>
  requires std::is_integral_v<T>
  void print(T value) { text += std::to_string(static_cast<long long>(value)); }
  void print(std::uint64_t value) { text += std::to_string(value); }
  /// By its bits.
  void print(float value) { print(std::bit_cast<std::uint32_t>(value)); }
  void print(double value) { print(std::bit_cast<std::uint64_t>(value)); }
  void print(const std::string& value) {
    text += '"';
    for (const char c : value) {
      char digits[3];
      std::snprintf(digits, sizeof digits, "%02x",
                    static_cast<unsigned>(static_cast<unsigned char>(c)));
      text += digits;
    }
    text += '"';
  }
  void print(const Inner& inner) {
    text += '{';
    (*this)(inner.a);
    (*this)(inner.b);
    (*this)(inner.c);
    text += '}';
  }
  template <typename T>
  void print(const std::vector<T>& list) {
    text += '[';
    for (const T& element : list) (*this)(element);
    text += ']';
  }
  template <typename T, std::size_t N>
  void print(const std::array<T, N>& list) {
    print(std::vector<std::conditional_t<std::is_same_v<T, bool>, std::uint8_t, T>>(list.begin(),
                                                                                    list.end()));
  }
};

std::string hex(std::span<const std::byte> bytes) {
  std::string text;
  for (const std::byte byte : bytes) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", std::to_integer<unsigned>(byte));
    text += digits;
  }
  return text;
}

std::string answer(const std::vector<std::byte>& bytes) {
  Everything all;
  Decoder from(bytes);
  if (!for_each(all, Take{from}) || !from.ended()) return "malformed";
  Print printed;
  for_each(all, printed);
  Body body;
  Encoder to(body);
  for_each(all, Put{to});
  return printed.text + "| " + hex(body.bytes());
}

}  // namespace

int main() {
  for (std::string line; std::getline(std::cin, line);) {
    std::vector<std::byte> bytes;
    for (std::size_t i = 0; i + 1 < line.size(); i += 2) {
      bytes.push_back(static_cast<std::byte>(std::stoi(line.substr(i, 2), nullptr, 16)));
    }
    std::cout << answer(bytes) << '\n';
  }
}
