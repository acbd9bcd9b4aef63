// SPDX-License-Identifier: Apache-2.0
#include "armature/library/base/controller_of_pids.hpp"

namespace armature::library {

using component::Outcome;
using control::Gathering;

Outcome ControllerOfPids::on_configure() {
  if (Outcome outcome = Controller::on_configure(); !outcome) return outcome;
  return set_up();
}

Outcome ControllerOfPids::on_start() {
  if (changes_.take()) {
    if (Outcome outcome = set_up(); !outcome) return outcome;
  }
  answers_->reset();
  missing_.reset();
  return Controller::on_start();
}

Outcome ControllerOfPids::set_up() {
  const std::size_t members = joints() + others();
  auto made = Gathering::make(
      {.members = members, .values_each = 1, .max_missing = missing_.max_missing()});
  if (!made) return component::refused(made.error());
  answers_ = std::move(made.value());
  missing_.resize(members);
  changes_.take();
  return component::accepted();
}

void ControllerOfPids::controller_now(const std::vector<double>& measured) {
  const std::vector<double>* const reference = reference_now(measured);
  if (reference == nullptr) return;
  const Gathering::Round round = answers_->begin();
  if (round.missing > 0) note_missing();
  if (round.overdue != Gathering::kNobody) {
    fault(missing_.give_up(round.overdue + 1, name_of(round.overdue),
                           answers_->missing_in_row(round.overdue)));
    return;
  }
  ask_others(*reference);
  for (std::size_t i = 0; i < ref_.size(); ++i) {
    ref_[i].write((*reference)[i]);
    sen_[i].write(measured[i]);
  }
  if (round.complete) conclude(answers_->values());
}

void ControllerOfPids::answer(std::size_t member, double value) {
  if (answers_->add(member, value)) conclude(answers_->values());
}

std::string_view ControllerOfPids::name_of(std::size_t member) {
  return member < out_.size() ? writer_of(out_[member]) : name_of_other(member);
}

void ControllerOfPids::note_missing() {
  const bool news =
      missing_.note(*answers_, [this](std::size_t member) { return name_of(member); });
  if (news) log_warning("no answer from {} in the last round", missing_.names());
}

}  // namespace armature::library
