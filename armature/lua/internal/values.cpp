// SPDX-License-Identifier: Apache-2.0
#include "armature/lua/internal/values.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/types/elements.hpp"
#include "armature/types/enum.hpp"

namespace armature::lua::internal {
namespace {

using types::Kind;
using types::Type;

constexpr int kStackForOne = 8;

template <typename T>
void push_scalar(lua_State* lua, T value) {
  if constexpr (std::is_same_v<T, bool>) {
    lua_pushboolean(lua, value);
  } else if constexpr (std::is_floating_point_v<T>) {
    lua_pushnumber(lua, static_cast<lua_Number>(value));
  } else if (std::in_range<lua_Integer>(value)) {
    lua_pushinteger(lua, static_cast<lua_Integer>(value));
  } else {
    lua_pushnumber(lua, static_cast<lua_Number>(value));
  }
}

/// Fills values of described types from the stack; each function returns what is wrong, beginning
/// with the path of the part, or nothing.
using Mistake = std::optional<std::string>;

std::string found_at(lua_State* lua, int index) {
  switch (lua_type(lua, index)) {
    case LUA_TNIL:
    case LUA_TNONE:
      return "nothing";
    case LUA_TTABLE:
    case LUA_TFUNCTION:
      return std::string("a ") + luaL_typename(lua, index);
    case LUA_TSTRING:
      return "the text '" + text_at(lua, index) + "'";
    default:
      return text_at(lua, index);
  }
}

Mistake must_be(const std::string& what, lua_State* lua, int index) {
  return " must be " + what + ", found " + found_at(lua, index);
}

template <typename T>
Mistake read_scalar(lua_State* lua, int index, const Type& type, void* to) {
  T value{};
  if constexpr (std::is_same_v<T, bool>) {
    if (lua_type(lua, index) != LUA_TBOOLEAN) return must_be("true or false", lua, index);
    value = lua_toboolean(lua, index) != 0;
  } else if constexpr (std::is_floating_point_v<T>) {
    if (lua_type(lua, index) != LUA_TNUMBER) return must_be("a number", lua, index);
    value = static_cast<T>(lua_tonumber(lua, index));
  } else {
    int whole = 0;
    const lua_Integer number = lua_tointegerx(lua, index, &whole);
    if (lua_type(lua, index) != LUA_TNUMBER || whole == 0) {
      return must_be("a whole number", lua, index);
    }
    if (!std::in_range<T>(number)) return must_be("in the range of " + type.name, lua, index);
    value = static_cast<T>(number);
  }
  std::memcpy(to, &value, sizeof value);
  return std::nullopt;
}

Mistake read(lua_State* lua, int index, const Type& type, void* to);

Mistake read_text(lua_State* lua, int index, const Type& type, void* to) {
  if (lua_type(lua, index) != LUA_TSTRING) return must_be("a text", lua, index);
  std::size_t size = 0;
  const char* const text = lua_tolstring(lua, index, &size);
  if (type.kind == Kind::kFixedText && size > type.count) {
    return " must have at most " + std::to_string(type.count) + " bytes, found " +
           std::to_string(size);
  }
  type.set_text(to, {text, size});
  return std::nullopt;
}

Mistake read_enumerator(lua_State* lua, int index, const Type& type, void* to) {
  if (lua_type(lua, index) != LUA_TSTRING) {
    return must_be("the text " + types::enumerator_list(type), lua, index);
  }
  const std::string name = text_at(lua, index);
  const types::Enumerator* const found = types::find_enumerator(type, name);
  if (found == nullptr) {
    const std::string hint = types::near_enumerator(type, name);
    return must_be(types::enumerator_list(type), lua, index).value() +
           (hint.empty() ? "" : " (" + hint + ")");
  }
  types::set_enumerator(type, *found, to);
  return std::nullopt;
}

std::size_t entries_of(lua_State* lua, int table) {
  std::size_t count = 0;
  for (lua_pushnil(lua); lua_next(lua, table) != 0; lua_pop(lua, 1)) ++count;
  return count;
}

Mistake read_list(lua_State* lua, int index, const Type& type, void* to) {
  const bool array = type.kind == Kind::kArray;
  const std::string wanted =
      array ? "a list of " + std::to_string(type.count) + " elements" : "a list";
  if (lua_type(lua, index) != LUA_TTABLE) return must_be(wanted, lua, index);
  const std::size_t count = entries_of(lua, index);
  if (count != lua_rawlen(lua, index)) {
    return " must be " + wanted + ", found a table with other keys, or with gaps";
  }
  if (array && count != type.count) {
    return " must be " + wanted + ", found " + std::to_string(count);
  }
  if (!array) type.vector_resize(to, count);
  std::byte* const first = types::elements(type, to);
  for (std::size_t i = 0; i < count; ++i) {
    lua_rawgeti(lua, index, static_cast<lua_Integer>(i + 1));
    const Mistake mistake =
        read(lua, lua_gettop(lua), *type.element, first + i * type.element->size);
    lua_pop(lua, 1);
    if (mistake) return "[" + std::to_string(i + 1) + "]" + *mistake;
  }
  return std::nullopt;
}

Mistake refuse_other_keys(lua_State* lua, int index, const Type& type) {
  std::vector<std::string> known;
  for (const types::Field& field : type.fields) known.emplace_back(field.name);
  Mistake mistake;
  for (lua_pushnil(lua); lua_next(lua, index) != 0; lua_pop(lua, 1)) {
    const std::string key = text_at(lua, -2);
    if (mistake || std::find(known.begin(), known.end(), key) != known.end()) continue;
    mistake = " has no field '" + key + "'" + base::suggestion_in_brackets(key, known);
  }
  return mistake;
}

Mistake read_struct(lua_State* lua, int index, const Type& type, void* to) {
  if (lua_type(lua, index) != LUA_TTABLE) return must_be("a table", lua, index);
  if (Mistake mistake = refuse_other_keys(lua, index, type)) return mistake;
  for (const types::Field& field : type.fields) {
    lua_pushlstring(lua, field.name.data(), field.name.size());
    lua_rawget(lua, index);
    const Mistake mistake =
        read(lua, lua_gettop(lua), *field.type, types::at_offset(to, field.offset));
    lua_pop(lua, 1);
    if (mistake) return "." + std::string(field.name) + *mistake;
  }
  return std::nullopt;
}

Mistake read(lua_State* lua, int index, const Type& type, void* to) {
  luaL_checkstack(lua, kStackForOne, "value");
  if (type.sealed) return " must be a " + type.name + ", which only components make";
  if (types::is_text(type)) return read_text(lua, index, type, to);
  if (types::is_list(type)) return read_list(lua, index, type, to);
  if (type.kind == Kind::kStruct) return read_struct(lua, index, type, to);
  if (type.kind == Kind::kEnum) return read_enumerator(lua, index, type, to);
  return types::with_scalar(type.kind, [&]<typename T>(std::type_identity<T>) {
    return read_scalar<T>(lua, index, type, to);
  });
}

/// What a table is written as.
struct TableText {
  std::size_t most_elements;

  std::string of(lua_State* lua, int index, int depth) const;
  std::string list(lua_State* lua, int table, std::size_t count, int depth) const;
  std::string map(lua_State* lua, int table, int depth) const;
};

std::string TableText::list(lua_State* lua, int table, std::size_t count, int depth) const {
  std::string text = "[";
  for (std::size_t i = 1; i <= std::min(count, most_elements); ++i) {
    lua_rawgeti(lua, table, static_cast<lua_Integer>(i));
    text += (i > 1 ? ", " : "") + of(lua, lua_gettop(lua), depth + 1);
    lua_pop(lua, 1);
  }
  if (count > most_elements) text += ", ... " + std::to_string(count) + " elements";
  return text + "]";
}

std::string TableText::map(lua_State* lua, int table, int depth) const {
  std::vector<std::pair<std::string, std::string>> entries;
  for (lua_pushnil(lua); lua_next(lua, table) != 0; lua_pop(lua, 1)) {
    const int value = lua_gettop(lua);
    entries.emplace_back(of(lua, value - 1, 0), of(lua, value, depth + 1));
  }
  std::sort(entries.begin(), entries.end());
  std::string text = "{";
  for (const auto& [key, value] : entries) {
    text += (text.size() > 1 ? ", " : "") + key + ": " + value;
  }
  return text + "}";
}

std::string TableText::of(lua_State* lua, int index, int depth) const {
  constexpr int kDeepest = 16;
  luaL_checkstack(lua, kStackForOne, "text");
  if (lua_type(lua, index) == LUA_TTABLE && luaL_getmetafield(lua, index, "__tostring") == 0) {
    if (depth > kDeepest) return "...";
    const std::size_t count = entries_of(lua, index);
    const bool is_list = count == lua_rawlen(lua, index);
    return is_list ? list(lua, index, count, depth) : map(lua, index, depth);
  }
  if (lua_type(lua, index) == LUA_TTABLE) lua_pop(lua, 1);  // its __tostring
  const bool quote = depth > 0 && lua_type(lua, index) == LUA_TSTRING;
  std::size_t size = 0;
  const char* const content = luaL_tolstring(lua, index, &size);
  std::string text(content, size);
  lua_pop(lua, 1);
  return quote ? "'" + text + "'" : text;
}

}  // namespace

void push_value(lua_State* lua, const Type& type, const void* value) {
  luaL_checkstack(lua, kStackForOne, "value");
  if (types::is_text(type)) {
    const std::string_view text = type.text(value);
    lua_pushlstring(lua, text.data(), text.size());
  } else if (types::is_list(type)) {
    const std::size_t count = types::element_count(type, value);
    const std::byte* const first = types::elements(type, value);
    lua_createtable(lua, static_cast<int>(count), 0);
    for (std::size_t i = 0; i < count; ++i) {
      push_value(lua, *type.element, first + i * type.element->size);
      lua_rawseti(lua, -2, static_cast<lua_Integer>(i + 1));
    }
  } else if (type.kind == Kind::kStruct) {
    lua_createtable(lua, 0, static_cast<int>(type.fields.size()));
    for (const types::Field& field : type.fields) {
      lua_pushlstring(lua, field.name.data(), field.name.size());
      push_value(lua, *field.type, types::at_offset(value, field.offset));
      lua_rawset(lua, -3);
    }
  } else if (type.kind == Kind::kEnum) {
    const std::string name = types::to_text(type, value);
    lua_pushlstring(lua, name.data(), name.size());
  } else {
    types::with_scalar(type.kind, [&]<typename T>(std::type_identity<T>) {
      T scalar{};
      std::memcpy(&scalar, value, sizeof scalar);
      push_scalar(lua, scalar);
      return 0;
    });
  }
}

base::Result<types::Value> value_at(lua_State* lua, int index, const Type& type) {
  types::Value value(type);
  if (const Mistake mistake = read(lua, lua_absindex(lua, index), type, value.data())) {
    return base::Error{*mistake};
  }
  return value;
}

std::string text_at(lua_State* lua, int index, std::size_t most_elements) {
  return TableText{most_elements}.of(lua, lua_absindex(lua, index), 0);
}

}  // namespace armature::lua::internal
