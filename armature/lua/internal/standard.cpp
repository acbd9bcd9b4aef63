// SPDX-License-Identifier: Apache-2.0
#include "armature/lua/internal/standard.hpp"

#include <algorithm>
#include <cctype>

#include "armature/lua/internal/values.hpp"
#include "armature/platform/file.hpp"

namespace armature::lua::internal {
namespace {

using Print = std::function<void(std::string_view)>;

/// Of Lua's functions these would load code from elsewhere, or run where no time limit holds.
constexpr const char* kLeftOut[] = {"collectgarbage", "dofile", "load",
                                    "loadfile",       "warn",   "xpcall"};

/// Tables are gone through in the order of their keys, since Lua's own order differs from run to
/// run; a finalizer would run where no time limit holds.
constexpr std::string_view kPrelude = R"(
local load_module = ...
local next, type, tostring, rawget = next, type, tostring, rawget
local error, pcall = error, pcall
local sort, set_metatable = table.sort, setmetatable

local function before(a, b)
  local first, second = type(a), type(b)
  if first ~= second then return first < second end
  if first == "number" or first == "string" then return a < b end
  if first == "boolean" then return tostring(a) < tostring(b) end
  return false
end

function pairs(all)
  if type(all) ~= "table" then error("pairs takes a table, found " .. type(all), 2) end
  local keys, i = {}, 0
  for key in next, all do keys[#keys + 1] = key end
  sort(keys, before)
  return function()
    while i < #keys do
      i = i + 1
      local value = rawget(all, keys[i])
      if value ~= nil then return keys[i], value end
    end
  end, all, nil
end

function setmetatable(all, meta)
  if type(meta) == "table" and rawget(meta, "__gc") ~= nil then
    error("a metatable of a script has no __gc", 2)
  end
  local done, result = pcall(set_metatable, all, meta)
  if not done then error(result, 2) end
  return result
end

function array(...) return {...} end

local loaded = {}
function require(name)
  local entry = loaded[name]
  if entry == nil then
    local chunk, problem, placed = load_module(name)
    if chunk == nil then error(problem, placed and 0 or 2) end
    loaded[name] = {problem = "'" .. name .. "' requires itself"}
    entry = {value = chunk(name)}
    loaded[name] = entry
  end
  if entry.problem then error(entry.problem, 2) end
  return entry.value
end

math.randomseed(1)
string.dump = nil
)";

int print(lua_State* lua) {
  const auto& sink = *static_cast<const Print*>(lua_touserdata(lua, lua_upvalueindex(1)));
  std::string line;
  for (int i = 1; i <= lua_gettop(lua); ++i) line += (i > 1 ? "\t" : "") + text_at(lua, i);
  if (sink) sink(line);
  return 0;
}

bool is_module_name(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char letter) {
    return std::isalnum(letter) != 0 || letter == '_' || letter == '-';
  });
}

/// The chunk; or nil, why, and whether that begins with a place.
int load_module(lua_State* lua) {
  auto& sources = *static_cast<Sources*>(lua_touserdata(lua, lua_upvalueindex(1)));
  const std::string name = text_at(lua, 1);
  lua_pushnil(lua);
  if (lua_type(lua, 1) != LUA_TSTRING || !is_module_name(name)) {
    lua_pushliteral(lua, "require takes the name of a script beside this one, without .lua");
    return 2;
  }
  const std::string path = sources.path_of_module(name);
  const base::Result<std::string> text = platform::read_file(path);
  if (!text) {
    lua_pushlstring(lua, text.error().data(), text.error().size());
    return 2;
  }
  if (compile(lua, text.value(), sources.name_of(path))) return 1;
  lua_pushboolean(lua, 1);
  return 3;
}

}  // namespace

void install_standard(lua_State* lua, const Print& print_line, Sources& sources) {
  luaL_requiref(lua, LUA_GNAME, luaopen_base, 1);
  luaL_requiref(lua, LUA_TABLIBNAME, luaopen_table, 1);
  luaL_requiref(lua, LUA_STRLIBNAME, luaopen_string, 1);
  luaL_requiref(lua, LUA_MATHLIBNAME, luaopen_math, 1);
  luaL_requiref(lua, LUA_UTF8LIBNAME, luaopen_utf8, 1);
  for (const char* name : kLeftOut) {
    lua_pushnil(lua);
    lua_setglobal(lua, name);
  }
  lua_pushlightuserdata(lua, const_cast<Print*>(&print_line));
  lua_pushcclosure(lua, print, 1);
  lua_setglobal(lua, "print");
  if (luaL_loadbufferx(lua, kPrelude.data(), kPrelude.size(), "=prelude", "t") != LUA_OK) {
    lua_error(lua);
  }
  lua_pushlightuserdata(lua, &sources);
  lua_pushcclosure(lua, load_module, 1);
  lua_call(lua, 1, 0);
}

}  // namespace armature::lua::internal
