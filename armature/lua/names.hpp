// SPDX-License-Identifier: Apache-2.0
#pragma once

// How Lua spells the names of components: `aic-1` is no name of Lua's, `_G["aic-1"]` is.

#include <string>
#include <string_view>

namespace armature::lua {

/// `Joint1`, `left.Finger`, `_G["aic-1"]`.
std::string in_lua(std::string_view component);

/// The other way round: `aic-1.Gain` of `_G["aic-1"].Gain`, `aic-1` of `"aic-1"`.
std::string without_lua(std::string_view text);

}  // namespace armature::lua
