// SPDX-License-Identifier: Apache-2.0
#include "armature/lua/internal/table_reader.hpp"

#include <algorithm>

#include "armature/base/near_name.hpp"
#include "armature/lua/internal/values.hpp"

namespace armature::lua::internal {

void TableReader::complain(const std::string& place, const std::string& problem) {
  if (has_said_enough()) return;
  problems_.push_back(place.empty() ? problem : place + ": " + problem);
}

bool TableReader::get(int table, const char* key) {
  lua_pushstring(lua_, key);
  return lua_rawget(lua_, table) != LUA_TNIL;
}

std::string TableReader::top() const {
  const int type = lua_type(lua_, -1);
  if (type == LUA_TNIL) return "nothing";
  if (type == LUA_TFUNCTION || type == LUA_TTABLE)
    return std::string("a ") + lua_typename(lua_, type);
  return type == LUA_TSTRING ? "'" + text_at(lua_, -1) + "'" : text_at(lua_, -1);
}

std::vector<std::string> TableReader::keys(int table, const std::string& place, int positions) {
  std::vector<std::string> names;
  int unnamed = 0;
  for (lua_pushnil(lua_); lua_next(lua_, table) != 0; lua_pop(lua_, 1)) {
    const bool at_position = lua_isinteger(lua_, -2) != 0 && lua_tointeger(lua_, -2) >= 1 &&
                             lua_tointeger(lua_, -2) <= positions;
    if (lua_type(lua_, -2) == LUA_TSTRING) {
      names.emplace_back(lua_tostring(lua_, -2));
    } else if (!at_position) {
      ++unnamed;
    }
  }
  std::sort(names.begin(), names.end());
  if (unnamed > 0) complain(place, std::to_string(unnamed) + " of its values have no name");
  return names;
}

void TableReader::complain_of_key(const std::string& place, const std::string& name,
                                  const std::vector<std::string>& known,
                                  const std::string& remark) {
  complain(place,
           "'" + name + "' is not a key here" + base::suggestion_in_brackets(name, known) + remark);
}

std::string TableReader::text(int table, const char* key, const std::string& place) {
  std::string text;
  if (get(table, key)) {
    if (is(LUA_TSTRING)) {
      text = lua_tostring(lua_, -1);
    } else {
      complain(place, std::string(key) + " must be a text, found " + top());
    }
  }
  lua_pop(lua_, 1);
  return text;
}

int TableReader::function(int table, const char* key, const std::string& place) {
  const bool there = get(table, key);
  if (there && is(LUA_TFUNCTION)) return luaL_ref(lua_, LUA_REGISTRYINDEX);
  if (there) complain(place, std::string(key) + " must be a function, found " + top());
  lua_pop(lua_, 1);
  return LUA_NOREF;
}

}  // namespace armature::lua::internal
