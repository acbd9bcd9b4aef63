// SPDX-License-Identifier: Apache-2.0
#include "armature/component/states/state_machine.hpp"

#include <algorithm>

#include "armature/base/near_name.hpp"
#include "armature/component/host.hpp"

namespace armature::component {
namespace {

/// So many triggers in a row may each come from the transition before.
constexpr int kMostInARow = 64;

using Cause = MachineTransition::Cause;

}  // namespace

std::string_view name_of(TriggerStatus status) {
  switch (status) {
    case TriggerStatus::kNotRunning:
      return "not running";
    case TriggerStatus::kIgnored:
      return "ignored";
    case TriggerStatus::kQueueFull:
      return "queue full";
    case TriggerStatus::kTaken:
      return "taken";
    case TriggerStatus::kQueued:
      return "queued";
  }
  return "unknown";
}

TriggerStatus Trigger::raise() {
  TriggerStatus best = TriggerStatus::kNotRunning;
  for (const Use& use : uses_) best = std::max(best, use.machine->post(use.index));
  return best;
}

OperationTrigger::OperationTrigger(Component* owner, std::string_view name, std::string_view doc)
    : Trigger(name),
      operation_(
          owner, name,
          [](void* self) {
            return static_cast<OperationTrigger*>(self)->raise() >= TriggerStatus::kTaken;
          },
          this, doc, in_own_thread) {}

namespace internal {

std::string function_name(std::string_view signature) {
  // "... [with auto Function = &Chassis::brake; ...]" or "[Function = &Chassis::brake]".
  std::size_t begin = signature.find("Function = ");
  if (begin == std::string_view::npos) return {};
  const std::string_view value =
      signature.substr(begin, signature.find_first_of(";]", begin) - begin);
  begin = value.rfind("::");
  return begin == std::string_view::npos ? std::string() : std::string(value.substr(begin + 2));
}

}  // namespace internal

/// While it lives, triggers wait.
class StateMachine::Busy {
 public:
  explicit Busy(StateMachine& machine) : machine_(machine), before_(machine.busy_) {
    machine_.busy_ = true;
  }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;
  ~Busy() { machine_.busy_ = before_; }

 private:
  StateMachine& machine_;
  bool before_;
};

/// Has an event of the component itself handled as a trigger.
class StateMachine::OwnEvent final : public EventListener {
 public:
  OwnEvent(StateMachine& machine, std::size_t trigger) : machine_(machine), trigger_(trigger) {}
  void event_raised() override { machine_.post(trigger_); }

 private:
  StateMachine& machine_;
  std::size_t trigger_;
};

StateMachine::StateMachine(Component& owner, std::string_view name, std::string_view doc) noexcept
    : owner_(owner), name_(name), doc_(doc) {
  Host::declare(owner_).machines.push_back(this);
  Host::add_step(owner_, *this, true);
}

StateMachine::StateMachine(Component* owner, std::string_view name, std::string_view doc,
                           MachineTable table)
    : StateMachine(*owner, name, doc) {
  table_ = std::move(table);
  prepare();
}

StateMachine::~StateMachine() {
  std::erase(Host::declare(owner_).machines, this);
  Host::remove_step(owner_, *this);
}

// --- definition ----------------------------------------------------------------------------------

void StateMachine::define(const StateDefinition& root) {
  for (const TransitionDefinition& stray : root.transitions) {
    problems_.push_back("a transition to '" + stray.target + "' stands outside of all states");
  }
  for (const StateDefinition& state : root.substates) define_states(state, kNoState);
  int next = 0;
  for (const StateDefinition& state : root.substates) define_transitions(state, next);
  prepare();
}

void StateMachine::define_states(const StateDefinition& definition, int parent) {
  const int self = static_cast<int>(table_.states.size());
  table_.states.push_back(definition.state);
  table_.states.back().parent = parent;
  for (const StateDefinition& substate : definition.substates) define_states(substate, self);
}

/// @param state  index of the state; afterwards that of the one defined next
void StateMachine::define_transitions(const StateDefinition& definition, int& state) {
  const int self = state++;
  for (const TransitionDefinition& each : definition.transitions) {
    MachineTransition transition = each.transition;
    transition.source = self;
    if (transition.cause == Cause::kTrigger) transition.trigger = index_of(each);
    if (!each.target.empty()) transition.target = table_.find(each.target, self);
    if (!each.target.empty() && transition.target == kNoState) {
      std::vector<std::string> names;
      for (const MachineState& known : table_.states) names.push_back(known.name);
      problems_.push_back("a transition of state '" + table_.path(self) + "' goes to '" +
                          each.target + "', which does not exist; " +
                          base::suggestion(each.target, names).text);
      continue;
    }
    table_.transitions.push_back(std::move(transition));
  }
  for (const StateDefinition& substate : definition.substates) define_transitions(substate, state);
}

std::size_t StateMachine::index_of(const TransitionDefinition& definition) {
  const void* const key = definition.trigger != nullptr
                              ? static_cast<const void*>(definition.trigger)
                              : static_cast<const void*>(definition.event);
  for (const auto& [known, index] : trigger_indices_) {
    if (known == key) return index;
  }
  const std::size_t index = table_.triggers.size();
  trigger_indices_.emplace_back(key, index);
  if (definition.trigger != nullptr) {
    table_.triggers.emplace_back(definition.trigger->name());
    definition.trigger->uses_.push_back({this, index});
  } else {
    table_.triggers.emplace_back(definition.event->name());
    own_events_.push_back(std::make_unique<OwnEvent>(*this, index));
    definition.event->add_listener(*own_events_.back());
  }
  return index;
}

/// Checks the table and lays out what running needs.
void StateMachine::prepare() {
  for (std::string& problem : check_table(table_)) problems_.push_back(std::move(problem));
  if (!problems_.empty()) return;
  Component* const self = &owner_;
  const auto bind = [self](auto& callable) {
    if (callable.self == nullptr) callable.self = self;
  };
  for (MachineState& state : table_.states) {
    bind(state.entry);
    bind(state.during);
    bind(state.exit);
  }
  std::stable_sort(table_.transitions.begin(), table_.transitions.end(),
                   [](const auto& a, const auto& b) { return a.source < b.source; });
  transitions_of_.resize(table_.states.size());
  for (std::size_t i = 0; i < table_.transitions.size(); ++i) {
    bind(table_.transitions[i].guard);
    bind(table_.transitions[i].action);
    Range& range = transitions_of_[static_cast<std::size_t>(table_.transitions[i].source)];
    if (range.end == 0) range.begin = i;
    range.end = i + 1;
  }
  for (int i = 0; i < static_cast<int>(table_.states.size()); ++i) {
    paths_.push_back(table_.path(i));
    initial_.push_back(table_.initial(i));
  }
  last_.assign(table_.states.size(), kNoState);
  entered_at_.assign(table_.states.size(), base::Time{});
}

// --- what tools see ------------------------------------------------------------------------------

std::string_view StateMachine::path() const {
  const int state = current();
  return state == kNoState ? std::string_view() : paths_[static_cast<std::size_t>(state)];
}

bool StateMachine::is_in(std::string_view state) const {
  const std::string_view now = path();
  return !state.empty() && now.substr(0, state.size()) == state &&
         (now.size() == state.size() || now[state.size()] == '/');
}

// --- running -------------------------------------------------------------------------------------

void StateMachine::start() {
  if (table_.states.empty() || !problems_.empty()) return;
  last_.assign(last_.size(), kNoState);
  changing_ = kNoState;
  active_ = true;
  const Busy busy(*this);
  if (enter_down_to(table_.initial(kNoState), kNoState) && enter_substates(false)) settle();
}

void StateMachine::halt(std::string_view) {
  ++life_;
  active_ = false;
  queued_ = 0;
  while (innermost_ != kNoState) {
    const int state = innermost_;
    innermost_ = at(state).parent;
    // What stops or faults the component from within an exit or entry action is not left once more.
    const bool interrupted = std::exchange(changing_, state) == state;
    const MachineAction& exit = at(state).exit;
    if (interrupted || exit.call == nullptr) continue;
    Host::run(owner_, Host::context(owner_), [&exit] { exit.call(exit.self); });
  }
  changing_ = kNoState;
  current_.store(kNoState, std::memory_order_relaxed);
}

void StateMachine::step() {
  if (!active_ || busy_) return;
  const Busy busy(*this);
  take_when_due();
  settle();
  run_during_actions(innermost_);
  settle();
}

TriggerStatus StateMachine::post(std::size_t trigger) {
  if (!active_ || owner_.state() != State::kRunning) return TriggerStatus::kNotRunning;
  if (busy_) {
    if (queued_ == kQueue) {
      ++refused_;
      return TriggerStatus::kQueueFull;
    }
    queue_[(queue_begin_ + queued_++) % kQueue] = trigger;
    return TriggerStatus::kQueued;
  }
  const Busy busy(*this);
  const bool taken = handle(trigger);
  settle();
  return taken ? TriggerStatus::kTaken : TriggerStatus::kIgnored;
}

bool StateMachine::handle(std::size_t trigger) {
  const bool taken = take_first(innermost_, [trigger](const MachineTransition& each) {
    return each.cause == Cause::kTrigger && each.trigger == trigger && each.guard.allows();
  });
  if (!taken) ++ignored_;
  return taken;
}

/// Takes the first transition that applies, from the innermost state outwards.
template <typename Applies>
bool StateMachine::take_first(int innermost, const Applies& applies) {
  for (int state = innermost; state != kNoState; state = at(state).parent) {
    const Range range = transitions_of_[static_cast<std::size_t>(state)];
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (!applies(table_.transitions[i])) continue;
      take(table_.transitions[i]);
      return true;
    }
  }
  return false;
}

bool StateMachine::take_when_due() {
  return take_first(innermost_, [this](const MachineTransition& each) {
    if (each.cause == Cause::kTime) {
      const base::Time entered = entered_at_[static_cast<std::size_t>(each.source)];
      return owner_.time() - entered >= each.after && each.guard.allows();
    }
    return each.cause == Cause::kCondition && each.guard.allows();
  });
}

bool StateMachine::take_when_done() {
  if (!at(innermost_).final) return false;
  const int parent = at(innermost_).parent;
  return take_first(parent, [parent](const MachineTransition& each) {
    return each.cause == Cause::kDone && each.source == parent && each.guard.allows();
  });
}

/// Carries out what transitions have caused, until the machine rests.
void StateMachine::settle() {
  for (int in_a_row = 0; in_a_row < kMostInARow; ++in_a_row) {
    if (!active_) return;
    if (take_when_done()) continue;
    if (queued_ == 0) return;
    const std::size_t trigger = queue_[queue_begin_];
    queue_begin_ = (queue_begin_ + 1) % kQueue;
    --queued_;
    handle(trigger);
  }
  owner_.fault(Reason("state machine '").append(name_).append("' does not come to rest"));
}

void StateMachine::take(const MachineTransition& transition) {
  ++taken_;
  if (transition.target == kNoState) {
    perform(transition.action);
    return;
  }
  int outer = at(transition.source).parent;
  while (!table_.contains(outer, transition.target)) outer = at(outer).parent;
  while (innermost_ != outer) {
    if (!leave(innermost_)) return;
  }
  if (!perform(transition.action) || !enter_down_to(transition.target, outer)) return;
  enter_substates(transition.to_history);
}

bool StateMachine::leave(int state) {
  const int parent = at(state).parent;
  if (parent != kNoState) last_[static_cast<std::size_t>(parent)] = state;
  if (!perform(at(state).exit, state)) return false;
  innermost_ = parent;
  return true;
}

bool StateMachine::enter(int state) {
  innermost_ = state;
  entered_at_[static_cast<std::size_t>(state)] = owner_.time();
  current_.store(state, std::memory_order_relaxed);
  return perform(at(state).entry, state);
}

/// Enters what lies between `outer` and `target`, then `target`; false if the machine was halted.
bool StateMachine::enter_down_to(int target, int outer) {
  const int parent = at(target).parent;
  if (parent != outer && !enter_down_to(parent, outer)) return false;
  return enter(target);
}

bool StateMachine::enter_substates(bool from_history) {
  while (true) {
    const auto self = static_cast<std::size_t>(innermost_);
    const int last = from_history ? last_[self] : kNoState;
    const int next = last != kNoState && !at(last).final ? last : initial_[self];
    if (next == kNoState) return true;
    if (!enter(next)) return false;
  }
}

bool StateMachine::run_during_actions(int state) {
  return state == kNoState || (run_during_actions(at(state).parent) && perform(at(state).during));
}

/// @param changing  the state whose entry or exit action it is
/// @return false if the machine was halted meanwhile: whatever was under way is over
bool StateMachine::perform(const MachineAction& action, int changing) {
  if (action.call == nullptr) return true;
  const std::uint32_t life = life_;
  changing_ = changing;
  action.call(action.self);
  if (life != life_) return false;
  changing_ = kNoState;
  return true;
}

}  // namespace armature::component
