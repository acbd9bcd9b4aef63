// SPDX-License-Identifier: Apache-2.0
#include "armature/lua/internal/sandbox.hpp"

#include <cstdio>
#include <cstdlib>

#include "armature/base/seconds.hpp"
#include "armature/lua/internal/values.hpp"
#include "armature/platform/clock.hpp"

namespace armature::lua::internal {
namespace {

constexpr int kInstructionsBetweenChecks = 1000;

/// Threads of Lua inherit the pointer.
Sandbox*& sandbox_of(lua_State* lua) { return *static_cast<Sandbox**>(lua_getextraspace(lua)); }

}  // namespace

Sandbox::Sandbox(std::size_t memory_limit, base::Duration time_limit)
    : memory_limit_(memory_limit),
      time_limit_(time_limit),
      lua_(lua_newstate(&Sandbox::allocate, this)) {
  if (lua_ == nullptr) return;
  sandbox_of(lua_) = this;
  lua_sethook(lua_, &Sandbox::check, LUA_MASKCOUNT, kInstructionsBetweenChecks);
}

Sandbox::~Sandbox() {
  if (lua_ != nullptr) lua_close(lua_);
}

base::Result<void> Sandbox::call_protected() {
  lua_sethook(lua_, &Sandbox::check, LUA_MASKCOUNT, kInstructionsBetweenChecks);
  if (lua_pcall(lua_, 1, 0, 0) == LUA_OK) return {};
  base::Error error{text_at(lua_, -1)};
  lua_pop(lua_, 1);
  return error;
}

void Sandbox::restart_clock() { deadline_ = base::later(platform::monotonic_now(), time_limit_); }

void* Sandbox::allocate(void* self, void* block, std::size_t old_size, std::size_t new_size) {
  auto& sandbox = *static_cast<Sandbox*>(self);
  const std::size_t had = block == nullptr ? 0 : old_size;  // else old_size is a kind of object
  if (new_size == 0) {
    std::free(block);
    sandbox.used_ -= had;
    return nullptr;
  }
  if (new_size > had && new_size - had > sandbox.memory_limit_ - sandbox.used_) return nullptr;
  void* const moved = std::realloc(block, new_size);
  if (moved != nullptr) sandbox.used_ += new_size - had;
  return moved;
}

std::string Sandbox::reason_to_end() const {
  if (platform::monotonic_now() >= deadline_) {
    return "the script has run for more than " + seconds_text(time_limit_) + " without a wait";
  }
  return reason_to_end_ ? reason_to_end_() : std::string();
}

/// From then on every instruction is refused, so that no `pcall` of the script goes on.
void Sandbox::check(lua_State* lua, lua_Debug*) {
  const std::string reason = sandbox_of(lua)->reason_to_end();
  if (reason.empty()) return;
  lua_sethook(lua, &Sandbox::check, LUA_MASKCOUNT, 1);
  luaL_where(lua, 0);
  lua_pushlstring(lua, reason.data(), reason.size());
  lua_concat(lua, 2);
  lua_error(lua);
}

std::string seconds_text(base::Duration duration) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g s", base::to_seconds(duration));
  return text;
}

}  // namespace armature::lua::internal
