// SPDX-License-Identifier: Apache-2.0
#pragma once

// The component 0 of every node, as docs/ride.md writes it in the interface language.

#include <cstdint>
#include <string>

#include "armature/ride/interface.hpp"

namespace armature::ride::internal {

struct ComponentEntry {
  std::int32_t identifier = 0;
  std::string name;
  std::string interface;
  std::uint32_t digest = 0;
};
inline void encode(Encoder& to, const ComponentEntry& entry) {
  to.put(entry.identifier);
  to.put(entry.name);
  to.put(entry.interface);
  to.put(entry.digest);
}
inline bool decode(Decoder& from, ComponentEntry& entry) {
  return from.take(entry.identifier) && from.take(entry.name) && from.take(entry.interface) &&
         from.take(entry.digest);
}

inline constexpr std::uint32_t kDirectory = 0;
inline constexpr Number kFind =
    number_of("struct ComponentEntry{int,String,String,unsigned int} find(String)");
inline constexpr Number kList =
    number_of("Array<struct ComponentEntry{int,String,String,unsigned int}> list()");
inline constexpr Number kSubscribe = number_of("int subscribe(int,unsigned int,int)");
inline constexpr Number kUnsubscribe = number_of("int unsubscribe(int)");

}  // namespace armature::ride::internal
