// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/listener.hpp"

#include <string>

#include "armature/browser/internal/command_texts.hpp"

namespace armature::browser::internal {
void Listener::complain(std::string_view text) {
  surface_.complain(surface_.live() ? wrapped(surface_.paper(), text, 0, 0) : std::string(text));
}

void Listener::tell(const inspect::CommandStatus& command) {
  surface_.say(fate_text(surface_.paper(), command));
}

void Listener::show_progress(const std::vector<inspect::CommandStatus>& commands) {
  if (surface_.live()) surface_.show(progress_text(commands));
}

}  // namespace armature::browser::internal
