// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/command_texts.hpp"

#include "armature/component/operations/command.hpp"

namespace armature::browser::internal {

using component::CommandStage;
using inspect::CommandStatus;

std::string fate_text(const Paper& paper, const CommandStatus& command) {
  if (!command.ended) {
    const bool waits = command.stage == CommandStage::kWaiting;
    return command.name + (waits ? ": waits for the one before it" : ": under way") +
           "; `wait` waits for its end";
  }
  if (command.stage == CommandStage::kDone) {
    return command.name + ": " + inked(paper, Ink::kGood, "done");
  }
  std::string reason = command.reason;
  const std::string_view stage = component::name_of(command.stage);
  if (reason.starts_with(stage)) reason.erase(0, stage.size());  // `cancelled by its sender`
  if (!reason.empty() && reason.front() != ' ') reason = ": " + reason;
  return command.name + ": " + inked(paper, Ink::kBad, stage) + reason;
}

std::string progress_text(const std::vector<CommandStatus>& commands) {
  std::string text;
  for (const CommandStatus& one : commands) {
    text += (text.empty() ? "" : ", ") + one.name + number_text(" %3.0f %%", 100.0 * one.progress);
  }
  return text.empty() ? text : text + " (Ctrl-C cancels)";
}

}  // namespace armature::browser::internal
