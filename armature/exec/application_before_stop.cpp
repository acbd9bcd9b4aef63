// SPDX-License-Identifier: Apache-2.0
// Of Application: what the deployment has done before an orderly stop.
#include <algorithm>
#include <string>

#include "armature/exec/application.hpp"
#include "armature/exec/internal/tool_ticket.hpp"
#include "armature/platform/stop_signal.hpp"

namespace armature::exec {
namespace {

constexpr auto is_under_way = [](const auto& ticket) {
  return ticket->stage() == component::CommandStage::kAccepted;
};

/// @return whether a command was under way
bool cancel_all(const auto& tickets) {
  bool any = false;
  for (const auto& ticket : tickets) {
    if (!is_under_way(ticket)) continue;
    ticket->request_cancel();
    any = true;
  }
  return any;
}

}  // namespace

base::Diagnostics Application::run_before_stop(RunEnd end, const platform::StopSignal* stop) {
  base::Diagnostics diagnostics;
  if (end == RunEnd::kFaulted || end == RunEnd::kStoppedByReaction) return diagnostics;
  if (options_.before_stop.empty()) return diagnostics;
  if (stop != nullptr && stop->received()) stop = nullptr;  // That is why it is to stop.
  // What is under way would have what follows refused; whoever began it has gone.
  if (cancel_all(tickets_)) {
    run_until(
        now() + options_.before_stop_limit,
        [this] { return std::ranges::none_of(tickets_, is_under_way); }, stop);
  }
  for (const CommandName& name : options_.before_stop) {
    if (!in_good_order()) break;
    const std::string problem = run_last(name, stop);
    if (problem.empty()) continue;
    diagnostics.warning(
        {}, "before the stop, '" + name.component + "." + name.command + "' " + problem);
  }
  return diagnostics;
}

/// What went wrong; empty if it is done.
std::string Application::run_last(const CommandName& name, const platform::StopSignal* stop) {
  auto begun = begin(name.component, name.command, {});
  if (!begun) return "was refused: " + begun.error();
  const component::CommandHandle handle = std::move(begun).value();
  const RunEnd end = run_until(
      now() + options_.before_stop_limit, [&] { return handle.ended(); }, stop);
  if (end == RunEnd::kStopRequested) return "was cut short by a signal";
  if (!in_good_order()) return "was ended by a fault";
  if (!handle.ended()) {
    return "did not end within " +
           std::to_string(options_.before_stop_limit / std::chrono::seconds(1)) + " s";
  }
  if (handle.stage() == component::CommandStage::kDone) return {};
  return "was not done: " + std::string(handle.reason());
}

}  // namespace armature::exec
