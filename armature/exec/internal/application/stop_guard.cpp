// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/stop_guard.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "armature/base/quoted.hpp"

namespace armature::exec::internal {

using base::quoted;
using component::Component;
using component::Outcome;

std::string dotted(const CommandName& name) { return quoted(name.component + "." + name.command); }

Outcome StopGuard::stop(std::string_view name) {
  if (Component* const component = roster_.find(name)) {
    if (const auto held = holders_.held_by(*component)) return begin(*held);
    if (const auto kept = holders_.held_by_help_of(*component)) {
      return component::refused(quoted(name) + " was not stopped, since " +
                                quoted(kept->component) + " needs it and holds " + kept->what +
                                "; or stop " + quoted(kept->component) + " first");
    }
  }
  return transitions_.stop(name);
}

Outcome StopGuard::begin(const Held& held) {
  const auto way = std::ranges::find(before_stop_, held.component, &CommandName::component);
  const std::string why = quoted(held.component) + " was not stopped, since it holds " + held.what;
  if (way == before_stop_.end()) return component::refused(why);
  auto begun = tools_.begin(way->component, way->command, {}, Caller::kOperator);
  if (!begun) {
    return component::refused(why + " (" + dotted(*way) + " was refused: " + begun.error() + ")");
  }
  on_way_.push_back({*way, std::move(begun).value()});
  outlets_.say(quoted(held.component) + " stops when " + dotted(*way) + " is done");
  return component::accepted();
}

void StopGuard::finish() {
  for (std::size_t i = 0; i < on_way_.size();) {
    if (!on_way_[i].handle.ended()) {
      ++i;
      continue;
    }
    const WayToStop ended = std::move(on_way_[i]);
    on_way_.erase(on_way_.begin() + static_cast<std::ptrdiff_t>(i));
    end(ended);
  }
}

void StopGuard::end(const WayToStop& way) {
  const std::string& name = way.command.component;
  if (way.handle.stage() != component::CommandStage::kDone) {
    outlets_.say(quoted(name) + " was not stopped: " + dotted(way.command) + " " +
                 std::string(name_of(way.handle.stage())) + ", " +
                 std::string(way.handle.reason()));
    return;
  }
  if (const auto held = holders_.held_by(*roster_.find(name))) {
    outlets_.say(quoted(name) + " was not stopped: it still holds " + held->what);
    return;
  }
  const Outcome stopped = stop(name);
  if (!stopped) outlets_.say(std::string(stopped.reason()));
}

bool StopGuard::is_on_way(std::string_view name) const {
  return std::ranges::any_of(on_way_,
                             [&](const WayToStop& way) { return way.command.component == name; });
}

void StopGuard::cancel(std::string_view name) {
  for (WayToStop& way : on_way_) {
    if (way.command.component == name) way.handle.cancel();
  }
}

}  // namespace armature::exec::internal
