// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the task browser explains.

#include <string>
#include <string_view>
#include <vector>

#include "armature/exec/application.hpp"
#include "armature/script/internal/display.hpp"

namespace armature::script::internal {

/// A command of the task browser, or a function of its Lua.
struct Topic {
  std::string_view name;
  std::string_view usage;
  std::string_view summary;
  std::string_view detail;  ///< more, and examples; may be empty
};
const std::vector<Topic>& command_topics();
const std::vector<Topic>& function_topics();

/// What there is to type.
std::string help_overview(const Paper& paper);

/// Help on a command, a function, a component or a member of one; a mistake says what is near.
base::Result<std::string> help_on(const Paper& paper, exec::Application& application,
                                  std::string_view subject);

}  // namespace armature::script::internal
