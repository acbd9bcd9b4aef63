// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/death.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>

#include "armature/platform/elf/symbols.hpp"
#include "armature/rt/guard.hpp"

namespace armature::exec {
namespace {

template <std::size_t kSize>
void copy_text(const char* text, char (&room)[kSize]) {
  if (text == nullptr) return;
  const std::size_t size = std::min(std::strlen(text), kSize - 1);
  std::memcpy(room, text, size);
  room[size] = '\0';
}

/// How it came to die is not told: the functions of the watch, and of the C library behind it.
bool is_of_the_watch(std::string_view function) {
  return function.starts_with("armature::platform::(anonymous namespace)::bury") ||
         function.starts_with("armature::platform::(anonymous namespace)::on_") ||
         function.starts_with("armature::platform::(anonymous namespace)::at_");
}

/// Deeper than this lies only how the runtime came to call the component.
bool ends_stack(std::string_view function) {
  return function.starts_with("armature::exec::Engine::");
}

}  // namespace

void name_worker(platform::Death& death) {
  const rt::GuardState& state = rt::guard_state();
  copy_text(state.thread, death.thread_name);
  if (state.running_component == nullptr) return;
  copy_text(state.running_component(state.context), death.worker);
  death.workplace = state.context;
}

std::string sentence(const platform::Death& death) {
  const std::string worker(death.worker);
  const std::string thread(death.thread_name);
  const std::string who =
      worker.empty() ? std::string("the program itself, not a component,") : "'" + worker + "'";
  const std::string where = thread.empty() ? " in thread " + std::to_string(death.thread)
                                           : " in the thread '" + thread + "'";
  const bool called = death.kind == platform::Death::Kind::kExit;
  return who + where + (called ? " has called " : ": ") + death.what();
}

std::string stack_of(const platform::Death& death) {
  platform::Symbols symbols;
  std::string text;
  for (std::size_t i = 0; i < death.frame_count; ++i) {
    const platform::Symbols::Function function = symbols.at(death.frames[i]);
    if (is_of_the_watch(function.name)) {
      text.clear();
      continue;
    }
    text += "    " + (function.name.empty() ? std::string("?") : function.name) + "  [" +
            function.place + "]\n";
    if (ends_stack(function.name)) break;
  }
  return text;
}

}  // namespace armature::exec
