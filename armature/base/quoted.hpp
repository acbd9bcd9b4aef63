// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace armature::base {

/// `'Name'`, as names are in messages.
inline std::string quoted(std::string_view name) { return "'" + std::string(name) + "'"; }

}  // namespace armature::base
