// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/guard.hpp"

#include <cstdlib>

#include "armature/platform/elf/shared_object.hpp"
#include "armature/rt/loaded_guard.hpp"

/// Defined by libarmature_guard.so, if that is loaded.
extern "C" [[gnu::weak]] armature::rt::Guard* armature_guard();

namespace armature::rt {

GuardState& guard_state() noexcept {
  // The guard relies on the model: the state lies at the same place in every thread's memory.
  [[gnu::tls_model("initial-exec")]] static thread_local GuardState state;
  return state;
}

Guard* loaded_guard() { return armature_guard == nullptr ? nullptr : armature_guard(); }

std::vector<std::pair<std::string, std::string>> guard_environment(GuardMode mode) {
  // The guard lies where this library lies.
  std::string preload =
      platform::file_beside(reinterpret_cast<const void*>(&guard_state), "libarmature_guard.so");
  if (const char* others = std::getenv("LD_PRELOAD"); others != nullptr && *others != '\0') {
    preload.append(":").append(others);
  }
  const char* const modes[] = {"report", "abort", "count"};
  return {{"LD_PRELOAD", std::move(preload)}, {"ARMATURE_GUARD", modes[static_cast<int>(mode)]}};
}

}  // namespace armature::rt
