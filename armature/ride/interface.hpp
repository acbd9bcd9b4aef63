// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "armature/ride/wire.hpp"

namespace armature::ride {

/// What a peer has to be allowed to use an operation or event.
enum class Access : std::uint8_t { kRead, kCommand, kConfigure };

/// `read`, `command`, `configure`.
std::string_view name_of(Access access);

/// An operation or event in its canonical form, such as `void setVelocity(float,float)` or
/// `event ObjectPosition{int,int}`.
struct Declaration {
  std::string_view canonical;
  Access access = Access::kCommand;

  constexpr Number number() const { return number_of(canonical); }
  constexpr bool is_event() const { return canonical.starts_with("event "); }
};

/// An interface as the IDL has it. Lives as long as the program: rcidl writes it as a constant.
struct Interface {
  std::string_view name;
  std::span<const Declaration> declarations;
};

/// The FNV-1a hash of the canonical declarations, sorted and joined by `;`.
std::uint32_t digest(const Interface& interface);

/// Raised by any component when a command fails: `event Failed{String,String}`, the operation's
/// name and what happened. No part of an interface's digest.
struct Failed {
  std::string operation;
  std::string text;
};
inline constexpr Declaration kFailedDeclaration{"event Failed{String,String}", Access::kRead};
constexpr Number event_number(const Failed*) { return kFailedDeclaration.number(); }
inline void encode(Encoder& to, const Failed& failed) {
  to.put(failed.operation);
  to.put(failed.text);
}
inline bool decode(Decoder& from, Failed& failed) {
  return from.take(failed.operation) && from.take(failed.text);
}

}  // namespace armature::ride
