// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/base/result.hpp"
#include "armature/foxglove/internal/json.hpp"
#include "armature/foxglove/internal/shape.hpp"

namespace armature::foxglove::internal {

/// A value as files have it, `{gains: [1, 2], state: "on"}`, as JSON; enumerators are texts, and
/// what is not finite is null. What cannot be read becomes a text as it is.
Json json_of_text(const Shape& shape, const std::string& text);

/// And back: the error says what no property can be, such as null.
base::Result<std::string> text_of_json(const Json& json);

}  // namespace armature::foxglove::internal
