// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <lua5.4/lua.hpp>

namespace armature::lua::internal {

/// Reads tables that describe something by named values, without regard to metatables, and collects
/// what is wrong. A place, `state 'Out': after`, says where.
class TableReader {
 public:
  TableReader(lua_State* lua, std::vector<std::string>& problems)
      : lua_(lua), problems_(problems) {}

  /// Problems beyond those that anybody reads are left out.
  void complain(const std::string& place, const std::string& problem);
  bool has_said_enough() const { return problems_.size() >= kMostProblems; }

  /// Leaves the value on the stack; false if there is none.
  bool get(int table, const char* key);
  /// What is on top of the stack.
  bool is(int type) const { return lua_type(lua_, -1) == type; }
  std::string top() const;

  /// The keys that are texts, in their order; other keys, but for 1 to `positions`, are wrong.
  std::vector<std::string> keys(int table, const std::string& place, int positions = 0);
  /// `name` is a key that means nothing at `place`.
  void complain_of_key(const std::string& place, const std::string& name,
                       const std::vector<std::string>& known, const std::string& remark = {});

  /// Empty if there is none.
  std::string text(int table, const char* key, const std::string& place);
  /// A reference to keep it by; LUA_NOREF if there is none.
  int function(int table, const char* key, const std::string& place);

 private:
  static constexpr std::size_t kMostProblems = 30;

  lua_State* lua_;
  std::vector<std::string>& problems_;
};

}  // namespace armature::lua::internal
