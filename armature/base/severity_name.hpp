// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "armature/base/diagnostic.hpp"

namespace armature::base {

/// `note`, `warning` or `error`.
std::string_view name_of(Severity severity);

}  // namespace armature::base
