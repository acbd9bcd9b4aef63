// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "armature/edit/replacement.hpp"

namespace armature::studio::internal {

using Replacements = std::vector<edit::Replacement>;

/// What makes `after` of `before`: nothing, or one replacement of all between the bytes that both
/// begin and end with.
Replacements difference(std::string_view before, std::string_view after);

/// `mine` as it is on the text that others made by `theirs` of the one that both began with;
/// nothing where both changed the same place.
std::optional<Replacements> rebased(const Replacements& mine, const Replacements& theirs);

}  // namespace armature::studio::internal
