// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/listener.hpp"

#include <string>

#include "armature/browser/internal/command_texts.hpp"

namespace armature::browser::internal {
namespace {

remote::CommandStatus status_of(const lua::BegunCommand& command) {
  remote::CommandStatus status;
  status.command = command.name;
  status.stage = component::name_of(command.stage);
  status.ended = command.ended;
  status.progress = command.progress;
  status.reason = command.reason;
  return status;
}

}  // namespace

void Listener::complain(std::string_view text) {
  surface_.complain(surface_.live() ? wrapped(surface_.paper(), text, 0, 0) : std::string(text));
}

void Listener::tell(const lua::BegunCommand& command) {
  surface_.say(fate_text(surface_.paper(), status_of(command)));
}

void Listener::show_progress(const std::vector<lua::BegunCommand>& commands) {
  if (!surface_.live()) return;
  std::vector<remote::CommandStatus> statuses;
  for (const lua::BegunCommand& one : commands) statuses.push_back(status_of(one));
  surface_.show(progress_text(statuses));
}

}  // namespace armature::browser::internal
