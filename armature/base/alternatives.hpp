// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace armature::base {

/// `skip, catch_up or fault`, for messages; empty for none.
std::string alternatives(const std::vector<std::string>& names);

}  // namespace armature::base
