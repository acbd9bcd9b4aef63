// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "armature/ride/answer.hpp"
#include "armature/ride/codec.hpp"

namespace armature::ride {

/// An `Array<bool>` that is a parameter or a result on its own. C++ has it as bytes, of which only
/// 0 and 1 are sent and taken.
struct Flags {
  std::vector<std::uint8_t> bytes;
};
inline void encode(Encoder& to, const Flags& flags) { to.put_flags(flags.bytes); }
inline bool decode(Decoder& from, Flags& flags) { return from.take_flags(flags.bytes); }

/// The answer with the bytes themselves.
inline Answer<std::vector<std::uint8_t>> bytes_of(Answer<Flags> answer) {
  if (!answer.ok()) return {answer.code(), answer.error()};
  return Answer<std::vector<std::uint8_t>>(std::move(answer.value().bytes));
}

}  // namespace armature::ride
