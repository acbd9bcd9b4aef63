// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/missing_answers.hpp"

#include <algorithm>

#include "armature/controllers/base/reason_text.hpp"

namespace armature::controllers {

std::string_view writer_of(const component::InputPortBase& input) {
  return input.connected() ? input.writers().front()->owner().name() : input.name();
}

MissingAnswers::MissingAnswers(component::Component* owner)
    : max_missing_(
          owner, "max_missing", 3,
          "a component that does not answer in that many rounds in a row is given up: a fault", "",
          component::range(1, 1000)),
      incomplete_(owner, "incomplete_rounds", 0,
                  "rounds since the start in which an answer was missing"),
      missing_(owner, "missing", {}, "rounds since the start in which each did not answer"),
      names_(owner, "missing_names", {},
             "the components that did not answer in the last such round"),
      event_(owner, "Missing", "given up: the fault of this component follows",
             component::occasional, {"number", "name"}) {}

void MissingAnswers::resize(std::size_t members) {
  counts_.assign(members, 0);
  missing_.assign(counts_);
}

void MissingAnswers::reset() {
  std::fill(counts_.begin(), counts_.end(), 0);
  missing_.assign(counts_);
  incomplete_.assign(0);
  names_.assign({});
}

void MissingAnswers::begin_note() { text_.clear(); }

void MissingAnswers::add_name(std::string_view name) {
  if (!text_.empty()) text_.append(", ");
  text_.append(name);
}

void MissingAnswers::end_note() {
  incomplete_.assign(incomplete_ + 1);
  missing_.assign(counts_);
  names_.assign(text_);
}

component::Reason MissingAnswers::give_up(std::size_t number, std::string_view name, int rounds) {
  event_.raise(static_cast<int>(number), ComponentName(name));
  component::Reason why(name);
  why.append(" (number ");
  append_number(why, static_cast<double>(number));
  why.append(") did not answer in ");
  append_number(why, rounds);
  return why.append(rounds == 1 ? " round" : " rounds in a row");
}

}  // namespace armature::controllers
