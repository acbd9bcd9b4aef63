// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "armature/ride/codec.hpp"

namespace armature::ride {

/// An `Array<bool>` that is a parameter or a result: bytes, of which each is 0 or 1 on the wire,
/// and nothing else is taken.
struct Flags : std::vector<std::uint8_t> {
  using std::vector<std::uint8_t>::vector;
  Flags() = default;
  Flags(std::vector<std::uint8_t> bytes) : vector(std::move(bytes)) {}  // NOLINT: bytes are flags
};
inline void encode(Encoder& to, const Flags& flags) { to.put_flags(flags); }
inline bool decode(Decoder& from, Flags& flags) { return from.take_flags(flags); }

}  // namespace armature::ride
