// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/controller_of_pids.hpp"

#include <algorithm>
#include <string>

#include "armature/component/face.hpp"
#include "armature/component/interface.hpp"

namespace armature::controllers {

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
  return member < out_.size() ? writer_of(face(out_[member])) : name_of_other(member);
}

void ControllerOfPids::note_missing() {
  const bool news =
      missing_.note(*answers_, [this](std::size_t member) { return name_of(member); });
  if (news) log_warning("no answer from {} in the last round", missing_.names());
}

std::vector<DrivenJoint> ControllerOfPids::joints_behind(const component::InputPortBase* input,
                                                         const component::Check& check) {
  // Of the PID's samples, the PID itself knows how late they are.
  const std::vector<DrivenJoint>& joints = acted_joints(check);
  for (std::size_t i = 0; i < out_.size() && i < joints.size(); ++i) {
    if (&face(out_[i]) == input) return {joints[i]};
  }
  return Controller::joints_behind(input, check);
}

void ControllerOfPids::on_check(component::Check& check) const {
  Controller::on_check(check);
  for (const component::InputPortBase* const input : component::interface_of(*this).inputs) {
    const std::string_view name = input->name();
    const bool of_a_pid = name.starts_with("Out") &&
                          name.find_first_not_of("0123456789", 3) == std::string_view::npos;
    if (of_a_pid) check_pid(*input, std::string(name.substr(3)), check);
  }
}

void ControllerOfPids::check_pid(const component::InputPortBase& out, const std::string& number,
                                 component::Check& check) const {
  const auto fits = [&](const component::InputPortBase& input, const std::string& name) {
    return std::ranges::all_of(check.writers_of(input), [&](const auto* writer) {
      return &writer->owner() != this || writer->name() == name;
    });
  };
  for (const component::OutputPortBase* const writer : check.writers_of(out)) {
    const auto* const pid = dynamic_cast<const ControlsJoint*>(&writer->owner());
    if (pid == nullptr) continue;
    const std::string ref = "Ref" + number, sen = "Sen" + number;
    if (fits(pid->desired_input(), ref) && fits(pid->measured_input(), sen)) continue;
    const std::string name(writer->owner().name());
    check.error("'" + name + "' answers for joint " + number + ", and is given what is of another",
                "connect " + ref + " to " + name + "." + std::string(pid->desired_input().name()) +
                    " and " + sen + " to " + name + "." +
                    std::string(pid->measured_input().name()));
  }
}

}  // namespace armature::controllers
