// SPDX-License-Identifier: Apache-2.0
#include "armature/component/operations/commands_under_way.hpp"

#include <algorithm>

#include "armature/component/black_box.hpp"
#include "armature/component/operations/command_ticket.hpp"

namespace armature::component {
namespace {

BlackBox::Note::Kind kind_of(CommandStage stage) {
  using NoteKind = BlackBox::Note::Kind;
  switch (stage) {
    case CommandStage::kDone:
      return NoteKind::kDone;
    case CommandStage::kFailed:
      return NoteKind::kFailed;
    case CommandStage::kRefused:
      return NoteKind::kRefused;
    default:
      return NoteKind::kCancelled;
  }
}

}  // namespace

CommandsUnderWay::~CommandsUnderWay() {
  end_all(CommandStage::kCancelled, "its component has been destroyed");
}

void CommandsUnderWay::add(CommandTicket* ticket) { runs_[count_++] = {++newest_, ticket}; }

void CommandsUnderWay::end(std::uint64_t run, CommandStage stage, std::string_view reason) {
  const std::size_t place = place_of(run);
  if (place < count_) end_at(place, stage, reason);
}

std::size_t CommandsUnderWay::place_of(std::uint64_t run) const {
  std::size_t place = 0;
  while (place < count_ && runs_[place].number != run) ++place;
  return place;
}

void CommandsUnderWay::end(const CommandTicket& ticket, CommandStage stage,
                           std::string_view reason) {
  std::size_t place = 0;
  while (place < count_ && runs_[place].ticket != &ticket) ++place;
  if (place < count_) end_at(place, stage, reason);
}

void CommandsUnderWay::end_all(CommandStage stage, std::string_view reason) {
  while (count_ > 0) end_at(0, stage, reason);
}

void CommandsUnderWay::end_at(std::size_t place, CommandStage stage, std::string_view reason) {
  CommandTicket* const ticket = runs_[place].ticket;
  const auto at = runs_.begin() + static_cast<std::ptrdiff_t>(place);
  std::move(at + 1, runs_.begin() + static_cast<std::ptrdiff_t>(count_), at);
  --count_;
  note(command_.owner(), kind_of(stage), command_.name(), reason);
  if (ticket != nullptr) ticket->end(stage, reason);
}

}  // namespace armature::component
