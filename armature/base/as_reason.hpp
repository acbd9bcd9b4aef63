// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/diagnostic.hpp"

namespace armature::base {

/// The errors in one line, to be told as the reason for something else: `message (hint); ...`.
std::string as_reason(const Diagnostics& diagnostics);

}  // namespace armature::base
