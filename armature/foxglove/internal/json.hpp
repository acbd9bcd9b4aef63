// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace armature::foxglove::internal {

/// In the order in which it is written.
using Json = nlohmann::ordered_json;

/// What is not UTF-8, as texts of a library may be, is replaced, since JSON must be.
inline std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace armature::foxglove::internal
