// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/edit/internal/targets.hpp"

namespace armature::edit::internal {

/// `activity`, or one of its settings: `activity.priority`.
bool is_activity(const std::string& path);

/// @param text  `value` as the edit has it
void set_activity(const Targets& targets, const document::Value& value, const std::string& text,
                  Workshop& shop);

void unset_activity(const Targets& targets, Workshop& shop);

}  // namespace armature::edit::internal
