// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include <lua5.4/lua.hpp>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"

namespace armature::lua::internal {

/// Lua with bounded memory, and with bounded time between two waits.
class Sandbox {
 public:
  Sandbox(std::size_t memory_limit, base::Duration time_limit);
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;
  ~Sandbox();

  /// nullptr if there is not even memory to begin with.
  lua_State* lua() const { return lua_; }

  /// Runs `code(lua)` where errors of Lua end it; the error if one did.
  template <typename Code>
  base::Result<void> run_protected(Code code) {
    lua_pushcfunction(lua_, &Sandbox::call<Code>);
    lua_pushlightuserdata(lua_, &code);
    return call_protected();
  }

  /// The script's time begins anew.
  void restart_clock();

  /// `reason` is asked now and then while Lua runs: why that is to end, or nothing.
  void end_when(std::function<std::string()> reason) { reason_to_end_ = std::move(reason); }

 private:
  template <typename Code>
  static int call(lua_State* lua) {
    (*static_cast<Code*>(lua_touserdata(lua, 1)))(lua);
    return 0;
  }
  base::Result<void> call_protected();
  static void* allocate(void* self, void* block, std::size_t old_size, std::size_t new_size);
  static void check(lua_State* lua, lua_Debug* where);
  std::string reason_to_end() const;

  std::size_t memory_limit_;
  base::Duration time_limit_;
  std::size_t used_ = 0;
  base::Time deadline_ = base::Time::max();
  std::function<std::string()> reason_to_end_;
  lua_State* lua_;
};

/// `2 s`, `250 ms`.
std::string seconds_text(base::Duration duration);

}  // namespace armature::lua::internal
