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

/// What a task browser understands, as help and completion know it.
struct Language {
  std::string_view heading;     ///< of `examples`
  std::vector<Topic> examples;  ///< how values are shown and set, and operations called
  std::vector<Topic> commands;
  std::vector<Topic> functions;
  std::string_view quitting;  ///< what `quit` does
  std::string_view in_names;  ///< what is in names of components and members beside letters
};

/// Of the browser in the application's own process: commands, else Lua.
const Language& lua_language();
/// Of the browser in another process.
const Language& remote_language();

}  // namespace armature::browser::internal
