// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

namespace armature::browser::internal {

/// Something to type: a command of the task browser, a function of its Lua.
struct Topic {
  std::string_view name;
  std::string_view usage;
  std::string_view summary;
  std::string_view detail;  ///< more, and examples; may be empty
};

/// What there is to type in a language, as the task browser, its help and completion know it.
struct Vocabulary {
  std::string_view heading;     ///< of `examples`
  std::vector<Topic> examples;  ///< how values are shown and set, and operations called
  std::vector<Topic> commands;  ///< of the task browser
  std::vector<Topic> functions;
  std::vector<std::string_view> methods;  ///< of what functions and calls give: `cancel()`
  std::string_view quitting;              ///< what `quit` does
  std::string_view in_names;  ///< what is in names of components and members beside letters

  bool has_command(std::string_view name) const;
};

/// Of an application in this process: Lua.
const Vocabulary& lua_vocabulary();
/// Of one in another process: values and calls.
const Vocabulary& plain_vocabulary();

}  // namespace armature::browser::internal
