// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>

#include <lua5.4/lua.hpp>

#include "armature/base/diagnostic.hpp"

namespace armature::lua::internal {

/// The script and what it requires. Lua knows them by short names, people by their paths.
class Sources {
 public:
  explicit Sources(std::string path);

  const std::string& path() const { return path_; }
  /// The name by which Lua knows the script at `path`.
  std::string name_of(const std::string& path);
  /// The file that `require(module)` means.
  std::string path_of_module(const std::string& module) const;

  /// An error of Lua as a finding: `name.lua:3: text` has its place in front; of other errors it is
  /// where `lua` runs.
  base::Diagnostic diagnostic(lua_State* lua, const std::string& error) const;

 private:
  std::string path_;
  std::map<std::string, std::string> paths_;  ///< by name
};

/// Where in the registry the main part of the script is, until it runs.
inline constexpr const char* kMainPart = "armature main part";

/// Leaves the chunk, or an error, on the stack; only text, never compiled code.
bool compile(lua_State* lua, std::string_view text, const std::string& name);

}  // namespace armature::lua::internal
