// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "armature/exec/act.hpp"

namespace armature::exec {

// `ApplicationOptions::acts` is told of an act before it is done. If it is refused then, it is told
// that, too: by an act that says of which one, and has no time.

/// @param number  of the act, by the order in which acts are told, from 1
inline Act refusal(std::uint64_t number, std::string why) {
  return {.item = std::move(why), .time = base::Time::min(), .turn = number};
}
/// Whether it says that act number `turn` was refused, since `item`.
inline bool is_refusal(const Act& act) { return act.time == base::Time::min(); }

}  // namespace armature::exec
