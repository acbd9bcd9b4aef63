// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/guard.hpp"

namespace armature::rt {

GuardState& guard_state() noexcept {
  static thread_local GuardState state;
  return state;
}

}  // namespace armature::rt
