// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "armature/cli/component_templates.hpp"
#include "armature/cli/robot/new_robot.hpp"

namespace armature::cli {

/// Files that every new robot has; `@words@` are those of new_robot.cpp.
std::span<const FileTemplate> robot_templates();

/// Beside them, those of its drives: classes in C++, and the deployment on the real bus.
std::span<const FileTemplate> drive_templates(DriveKind kind);
std::span<const FileTemplate> can_templates();
std::span<const FileTemplate> own_templates();

}  // namespace armature::cli
