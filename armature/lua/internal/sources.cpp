// SPDX-License-Identifier: Apache-2.0
#include "armature/lua/internal/sources.hpp"

#include <cstdlib>
#include <filesystem>
#include <utility>

namespace armature::lua::internal {
namespace {

namespace fs = std::filesystem;

/// Lua keeps so much of a name in its messages.
constexpr std::size_t kLongestName = LUA_IDSIZE - 1;

/// The line of the innermost function that is written in Lua; 0 if there is none.
int line_of(lua_State* lua, std::string& name) {
  lua_Debug frame;
  for (int level = 0; lua_getstack(lua, level, &frame) != 0; ++level) {
    lua_getinfo(lua, "Sl", &frame);
    if (frame.currentline <= 0 || frame.source[0] != '@') continue;
    name = frame.short_src;
    return frame.currentline;
  }
  return 0;
}

}  // namespace

Sources::Sources(std::string path) : path_(std::move(path)) {}

std::string Sources::name_of(const std::string& path) {
  std::string name = fs::path(path).filename().string();
  if (name.size() > kLongestName) name = name.substr(name.size() - kLongestName);
  paths_[name] = path;
  return name;
}

std::string Sources::path_of_module(const std::string& module) const {
  return (fs::path(path_).parent_path() / (module + ".lua")).string();
}

base::Diagnostic Sources::diagnostic(lua_State* lua, const std::string& error) const {
  for (const auto& [name, path] : paths_) {
    if (error.compare(0, name.size() + 1, name + ":") != 0) continue;
    char* end = nullptr;
    const long line = std::strtol(error.c_str() + name.size() + 1, &end, 10);
    if (line <= 0 || end[0] != ':' || end[1] != ' ') continue;
    return {base::Severity::kError, {path, static_cast<int>(line), 0}, end + 2, {}};
  }
  std::string name;
  const int line = line_of(lua, name);
  const auto known = paths_.find(name);
  return {
      base::Severity::kError, {known == paths_.end() ? path_ : known->second, line, 0}, error, {}};
}

bool compile(lua_State* lua, std::string_view text, const std::string& name) {
  return luaL_loadbufferx(lua, text.data(), text.size(), ("@" + name).c_str(), "t") == LUA_OK;
}

}  // namespace armature::lua::internal
