// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

namespace armature::report {

/// Its keys stay in the order in which they were written.
using Json = nlohmann::ordered_json;

}  // namespace armature::report
