// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/command_texts.hpp"

#include "armature/component/operations/command.hpp"

namespace armature::browser::internal {

using component::CommandStage;
using remote::CommandStatus;

std::string fate_text(const Paper& paper, const CommandStatus& command) {
  if (!command.ended) return command.command + ": under way; `wait` waits for its end";
  if (command.stage == component::name_of(CommandStage::kDone)) {
    return command.command + ": " + inked(paper, Ink::kGood, "done");
  }
  std::string reason = command.reason;
  if (reason.starts_with(command.stage))
    reason.erase(0, command.stage.size());  // `cancelled by its sender`
  if (!reason.empty() && reason.front() != ' ') reason = ": " + reason;
  return command.command + ": " + inked(paper, Ink::kBad, command.stage) + reason;
}

std::string progress_text(const std::vector<CommandStatus>& commands) {
  std::string text;
  for (const CommandStatus& one : commands) {
    text +=
        (text.empty() ? "" : ", ") + one.command + number_text(" %3.0f %%", 100.0 * one.progress);
  }
  return text.empty() ? text : text + " (Ctrl-C cancels)";
}

}  // namespace armature::browser::internal
