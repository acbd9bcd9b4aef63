// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "armature/ride/codec.hpp"

namespace armature::idl {

/// `01 0a ff`
inline std::string hexadecimal(std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::byte byte : bytes) {
    if (!text.empty()) text += ' ';
    text += kDigits[std::to_integer<std::size_t>(byte >> 4)];
    text += kDigits[std::to_integer<std::size_t>(byte & std::byte{15})];
  }
  return text;
}

/// What a value is on the wire.
template <typename T>
std::string encoded(const T& value) {
  ride::Body body;
  ride::Encoder to(body);
  to.put(value);
  return hexadecimal(body.bytes());
}

/// Takes a value of what another one was encoded to; false if it was refused or bytes are left.
template <typename From, typename To>
bool transfer(const From& from, To& to) {
  ride::Body body;
  ride::Encoder encoder(body);
  encoder.put(from);
  ride::Decoder decoder(body.bytes());
  return decoder.take(to) && decoder.ended();
}

/// True if what begins with the same bytes, but ends earlier, is refused wherever it ends.
template <typename T>
bool refuses_every_beginning(const T& value) {
  ride::Body body;
  ride::Encoder encoder(body);
  encoder.put(value);
  for (std::size_t size = 0; size < body.size(); ++size) {
    T taken{};
    ride::Decoder decoder(body.bytes().first(size));
    if (decoder.take(taken)) return false;
  }
  return true;
}

}  // namespace armature::idl
