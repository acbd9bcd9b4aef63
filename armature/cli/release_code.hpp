// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace armature::cli {

/// Gives back the memory of code that a run does not need, before its first cycle. What is called
/// all the same is read in again, which no real-time thread may wait for.
/// @param networked  it has a part in a network
/// @param browsed    an operator types lines
/// @param scripted   a script commands it
void release_what_is_not_needed(bool networked, bool browsed, bool scripted);

}  // namespace armature::cli
