// SPDX-License-Identifier: Apache-2.0
#pragma once

// How the programs of this folder wait, and how they end.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "armature/platform/clock.hpp"

namespace kill_restart {

using namespace std::chrono_literals;
namespace base = armature::base;
namespace platform = armature::platform;

inline constexpr auto kPatience = 30s;

[[noreturn]] inline void fail(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::_Exit(1);
}

template <typename Condition>
inline void wait_until(const Condition& condition, const std::string& what) {
  const auto end = platform::monotonic_now() + kPatience;
  while (!condition()) {
    if (platform::monotonic_now() > end) fail("in vain: " + what);
    platform::sleep_until(platform::monotonic_now() + 100us);
  }
}

}  // namespace kill_restart
