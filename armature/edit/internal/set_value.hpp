// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "armature/edit/internal/workshop.hpp"

namespace armature::edit::internal {

/// True if `{i}`, a range or `${name}` in it stands for something else.
bool has_braces(const document::Value& value);

/// What an edit gives as YAML; an error and nothing if that is none, or nothing.
std::optional<document::Value> value_of(const std::string& text, const std::string& what,
                                        Workshop& shop);

}  // namespace armature::edit::internal
