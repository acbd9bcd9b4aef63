// SPDX-License-Identifier: Apache-2.0
#include "armature/component/states/machine_table.hpp"

#include <algorithm>

#include "armature/base/quoted.hpp"

namespace armature::component {

using base::quoted;

namespace {

using Cause = MachineTransition::Cause;

int child_of(const MachineTable& table, int parent, std::string_view name) {
  for (std::size_t i = 0; i < table.states.size(); ++i) {
    if (table.states[i].parent == parent && table.states[i].name == name) {
      return static_cast<int>(i);
    }
  }
  return kNoState;
}

/// The state at the end of `path`, which starts among the substates of `scope`.
int follow(const MachineTable& table, int scope, std::string_view path) {
  while (true) {
    const std::size_t slash = path.find('/');
    scope = child_of(table, scope, path.substr(0, slash));
    if (scope == kNoState || slash == std::string_view::npos) return scope;
    path.remove_prefix(slash + 1);
  }
}

/// Looks for everything that is wrong; `problems` grows.
class TableCheck {
 public:
  TableCheck(const MachineTable& table, std::vector<std::string>& problems)
      : table_(table), problems_(problems) {}

  void run() {
    if (table_.states.empty()) complain("it has no states");
    if (!check_parents()) return;
    check_names();
    bool sound = true;
    for (const MachineTransition& transition : table_.transitions) {
      sound = check_transition(transition) && sound;
    }
    if (sound) check_reachable();
  }

 private:
  void complain(std::string problem) { problems_.push_back(std::move(problem)); }

  const MachineState& at(int state) const { return table_.states[static_cast<std::size_t>(state)]; }
  bool exists(int state) const {
    return state >= 0 && state < static_cast<int>(table_.states.size());
  }
  bool is_composite(int state) const { return table_.initial(state) != kNoState; }
  std::string named(int state) const { return "state " + quoted(table_.path(state)); }

  bool check_parents() {
    for (int i = 0; i < static_cast<int>(table_.states.size()); ++i) {
      if (at(i).parent < i && at(i).parent >= kNoState) continue;
      complain("state " + quoted(at(i).name) + " comes before its parent");
      return false;
    }
    return true;
  }

  void check_names() {
    for (int i = 0; i < static_cast<int>(table_.states.size()); ++i) {
      const MachineState& state = at(i);
      if (state.name.empty()) complain("a state has no name");
      if (state.name.find('/') != std::string::npos) {
        complain("the name of state " + quoted(state.name) + " contains '/'");
      }
      if (child_of(table_, state.parent, state.name) != i) complain(named(i) + " exists twice");
      if (state.final && is_composite(i)) complain(named(i) + " is final and has substates");
    }
    for (std::size_t i = 0; i < table_.triggers.size(); ++i) {
      const auto begin = table_.triggers.begin();
      const auto self = begin + static_cast<std::ptrdiff_t>(i);
      if (std::find(begin, self, *self) != self)
        complain("trigger " + quoted(*self) + " exists twice");
    }
  }

  bool check_transition(const MachineTransition& transition) {
    if (!exists(transition.source) ||
        (transition.target != kNoState && !exists(transition.target)) ||
        (transition.cause == Cause::kTrigger && transition.trigger >= table_.triggers.size())) {
      complain("a transition refers to a state or trigger that does not exist");
      return false;
    }
    if (const std::string reason = objection(transition); !reason.empty()) {
      complain("transition " + quoted(table_.text(transition)) + ": " + reason);
    }
    return true;
  }

  std::string objection(const MachineTransition& transition) const {
    if (at(transition.source).final) return "a final state is never left";
    if (transition.target == kNoState && transition.cause != Cause::kTrigger) {
      return "it needs a target state; put what happens all the time into `during`";
    }
    if (transition.cause == Cause::kTime && transition.after <= base::Duration::zero()) {
      return "the time must be above 0";
    }
    if (transition.cause == Cause::kCondition && transition.guard.call == nullptr) {
      return "it has no condition";
    }
    if (transition.cause == Cause::kDone && !has_final_substate(transition.source)) {
      return named(transition.source) + " has no final substate, so it is never done";
    }
    if (transition.to_history && !is_composite(transition.target)) {
      return named(transition.target) + " has no substates to go back to";
    }
    return {};
  }

  bool has_final_substate(int state) const {
    return std::any_of(table_.states.begin(), table_.states.end(),
                       [state](const auto& each) { return each.parent == state && each.final; });
  }

  void check_reachable() {
    std::vector<bool> reached(table_.states.size(), false);
    reach(table_.initial(kNoState), reached);
    for (const MachineTransition& transition : table_.transitions) {
      reach(transition.target, reached);
    }
    for (int i = 0; i < static_cast<int>(reached.size()); ++i) {
      if (!reached[static_cast<std::size_t>(i)]) complain(named(i) + " is never entered");
    }
  }

  /// Marks what is active once `state` was entered.
  void reach(int state, std::vector<bool>& reached) const {
    for (int up = state; up != kNoState; up = at(up).parent) {
      reached[static_cast<std::size_t>(up)] = true;
    }
    for (int down = state; down != kNoState; down = table_.initial(down)) {
      reached[static_cast<std::size_t>(down)] = true;
      if (!is_composite(down)) break;
    }
  }

  const MachineTable& table_;
  std::vector<std::string>& problems_;
};

std::string cause_text(const MachineTable& table, const MachineTransition& transition) {
  switch (transition.cause) {
    case Cause::kTrigger:
      return "on " + table.triggers[transition.trigger];
    case Cause::kTime: {
      const auto us = std::chrono::duration_cast<std::chrono::microseconds>(transition.after);
      return us.count() % 1000 == 0 ? "after " + std::to_string(us.count() / 1000) + " ms"
                                    : "after " + std::to_string(us.count()) + " us";
    }
    case Cause::kCondition:
      return "when " +
             (transition.guard.name.empty() ? "its condition holds" : transition.guard.name);
    case Cause::kDone:
      return "when done";
  }
  return {};
}

}  // namespace

std::string MachineTable::path(int state) const {
  if (state == kNoState) return {};
  const MachineState& self = states[static_cast<std::size_t>(state)];
  return self.parent == kNoState ? self.name : path(self.parent) + "/" + self.name;
}

int MachineTable::find(std::string_view name, int from) const {
  while (true) {
    const int found = follow(*this, from, name);
    if (found != kNoState || from == kNoState) return found;
    from = states[static_cast<std::size_t>(from)].parent;
  }
}

int MachineTable::initial(int state) const {
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i].parent == state) return static_cast<int>(i);
  }
  return kNoState;
}

bool MachineTable::contains(int outer, int inner) const {
  if (outer == kNoState) return true;
  do {
    inner = states[static_cast<std::size_t>(inner)].parent;
  } while (inner != kNoState && inner != outer);
  return inner == outer;
}

std::string MachineTable::text(const MachineTransition& transition) const {
  std::string text = path(transition.source);
  if (transition.target != kNoState) {
    text += (transition.to_history ? " -> back to " : " -> ") + path(transition.target);
  }
  text += " " + cause_text(*this, transition);
  const bool guarded = transition.guard.call != nullptr && transition.cause != Cause::kCondition;
  if (guarded) {
    text += " [" + (transition.guard.name.empty() ? "guarded" : transition.guard.name) + "]";
  }
  if (!transition.action.name.empty()) text += " / " + transition.action.name;
  return text;
}

std::vector<std::string> check_table(const MachineTable& table) {
  std::vector<std::string> problems;
  TableCheck(table, problems).run();
  return problems;
}

}  // namespace armature::component
