// SPDX-License-Identifier: Apache-2.0
#include "armature/component/internal/waiting_commands.hpp"

namespace armature::component::internal {

WaitingCommands::WaitingCommands(const Signature& signature, std::size_t capacity)
    : places_(capacity + 1) {
  for (Place& each : places_) each.arguments = Arguments(signature);
}

void WaitingCommands::shape(const void* const* arguments) {
  for (Place& each : places_) each.arguments.assign(arguments);
}

void WaitingCommands::add(CommandTicket* ticket, const void* const* arguments) {
  Place& last = place(count_++);
  last.ticket = ticket;
  last.arguments.assign(arguments);
}

WaitingCommands::Command WaitingCommands::take_first() {
  Place& taken = place(0);
  first_ = (first_ + 1) % places_.size();
  --count_;
  return {taken.ticket, taken.arguments.places()};
}

WaitingCommands::Command WaitingCommands::take_last() {
  Place& taken = place(--count_);
  return {taken.ticket, taken.arguments.places()};
}

std::size_t WaitingCommands::find(const CommandTicket& ticket) const {
  std::size_t index = 0;
  while (index < count_ && place(index).ticket != &ticket) ++index;
  return index;
}

}  // namespace armature::component::internal
