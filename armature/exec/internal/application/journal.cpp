// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/journal.hpp"

#include <utility>

namespace armature::exec::internal {

void Journal::begin_anew() {
  turns_ = 0;
  told_ = 0;
  commands_ = 0;
}

std::uint32_t Journal::note(Act act) {
  if (!options_.acts) return 0;
  note_cancelled();
  if (act.kind == Act::Kind::kBegin) act.command = ++commands_;
  const std::uint32_t number = act.command;
  tell(std::move(act));
  return number;
}

void Journal::note_cancelled() {
  if (!options_.acts) return;
  for (const std::uint32_t command : tickets_.take_cancelled()) {
    tell({.kind = Act::Kind::kCancel, .command = command});
  }
}

void Journal::note_refused(std::uint64_t act, std::string why) {
  if (act == 0) return;
  options_.acts(
      {.kind = Act::Kind::kRefused, .item = std::move(why), .time = clock_.now(), .number = act});
}

void Journal::note_done(std::uint64_t act, base::Time when) {
  if (act == 0 || options_.simulated) return;
  options_.acts({.kind = Act::Kind::kDone, .time = when, .number = act});
}

void Journal::tell(Act act) {
  ++told_;
  act.time = clock_.now();
  act.turn = turns_;
  act.attended = attending_;
  options_.acts(act);
}

}  // namespace armature::exec::internal
