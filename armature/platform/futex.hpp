// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

#include "armature/base/time.hpp"

namespace armature::platform {

/// Sleeps while `word` holds `expected`; may also return for no reason, so callers look again.
void futex_wait(std::atomic<std::uint32_t>& word, std::uint32_t expected);

/// The same, but at most until `deadline` on the monotonic clock; false if the time ran out.
bool futex_wait_until(std::atomic<std::uint32_t>& word, std::uint32_t expected,
                      base::Time deadline);

/// Wakes one thread that sleeps on `word`.
/// @rt one system call, does not wait
void futex_wake_one(std::atomic<std::uint32_t>& word);

}  // namespace armature::platform
