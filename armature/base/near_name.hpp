// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/base/hint.hpp"

namespace armature::base {

/// The candidate that a user most likely meant by `name`: equal but for case, or at most a third of
/// its letters away. Empty if none is near.
std::string near_name(std::string_view name, const std::vector<std::string>& candidates);

/// `did you mean 'X'?` with that change, or nothing.
Hint near_hint(std::string_view name, const std::vector<std::string>& candidates);

/// `did you mean 'X'?` with that change, or `known: A, B, C` for at most eight candidates, or
/// nothing.
Hint suggestion(std::string_view name, const std::vector<std::string>& candidates);

/// The same for the end of a message: ` (did you mean 'X'?)`, or nothing.
std::string suggestion_in_brackets(std::string_view name,
                                   const std::vector<std::string>& candidates);

}  // namespace armature::base
