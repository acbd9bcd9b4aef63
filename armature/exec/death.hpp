// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/platform/death_watch.hpp"

namespace armature::exec {

/// Says which component runs in the calling thread; for `platform::DeathWatch`. Its `workplace` is
/// the ExecutionContext, nullptr while none of a thread of the application.
/// @rt async-signal-safe
void name_worker(platform::Death& death);

/// `'Filter' in the thread 'Sampler': segmentation fault at address 0x10`.
std::string sentence(const platform::Death& death);

/// A line for each frame of its call stack, innermost first.
std::string stack_of(const platform::Death& death);

}  // namespace armature::exec
