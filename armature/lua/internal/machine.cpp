// SPDX-License-Identifier: Apache-2.0
#include "armature/lua/internal/machine.hpp"

#include <algorithm>
#include <utility>

#include "armature/component/host.hpp"
#include "armature/lua/internal/machines.hpp"
#include "armature/lua/internal/schedule.hpp"
#include "armature/lua/internal/subscriptions.hpp"

namespace armature::lua::internal {

using component::kNoState;
using Cause = component::MachineTransition::Cause;

void MachineFunction::perform(void* self) {
  const auto& function = *static_cast<const MachineFunction*>(self);
  function.machine->perform(function);
}

bool MachineFunction::ask(void* self) {
  const auto& function = *static_cast<const MachineFunction*>(self);
  return function.machine->ask(function);
}

Machine::Machine(MachineDefinition definition, Machines& machines)
    : definition_(std::move(definition)),
      machines_(machines),
      context_(definition_.name),
      owner_(definition_.name),
      machine_(&owner_, definition_.name, "", definition_.table),
      afters_(definition_.states.size()),
      periodic_(definition_.states.size(), false),
      entered_at_(definition_.states.size()),
      runs_(definition_.states.size(), nullptr),
      arguments_(definition_.triggers.size(), LUA_NOREF) {
  component::Host::assign_context(owner_, context_);
  for (MachineFunction& function : definition_.functions) function.machine = this;
  for (std::size_t i = 0; i < definition_.states.size(); ++i) {
    periodic_[i] = definition_.table.states[i].during.call != nullptr;
  }
  for (const component::MachineTransition& transition : definition_.table.transitions) {
    const auto source = static_cast<std::size_t>(transition.source);
    if (transition.cause == Cause::kTime) afters_[source].push_back(transition.after);
    if (transition.cause == Cause::kCondition) periodic_[source] = true;
  }
}

bool Machine::at_end() const {
  const int state = machine_.current();
  if (state == kNoState) return false;
  const component::MachineState& self = definition_.table.states[static_cast<std::size_t>(state)];
  return self.final && self.parent == kNoState;
}

// --- turns ---------------------------------------------------------------------------------------

/// While it lives, the machine may act.
class Machine::Turn {
 public:
  explicit Turn(Machine& machine) : machine_(machine) {
    ++machine_.turns_;
    machine_.context_.cycle_time = machine_.machines_.schedule().instant();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;
  ~Turn() {
    --machine_.turns_;
    machine_.end_turn();
  }

 private:
  Machine& machine_;
};

void Machine::end_turn() {
  if (!running()) stop_listening();
  if (owner_.state() != component::State::kException || std::exchange(fault_told_, true)) return;
  machines_.note_mistake("machine '" + name() + "': " + std::string(owner_.reason()));
}

void Machine::start(lua_State* lua) {
  stop();
  const Turn turn(*this);
  fault_told_ = false;
  stepped_at_ = context_.cycle_time;
  next_period_ = base::later(stepped_at_, definition_.period);
  listen(lua);
  component::Outcome ready = component::accepted();
  if (owner_.state() == component::State::kException) ready = component::Host::reset(owner_);
  if (owner_.state() == component::State::kPreOperational)
    ready = component::Host::configure(owner_);
  if (ready) ready = component::Host::start(owner_);
  if (!ready && !running()) machines_.note_mistake(std::string(ready.reason()));
}

void Machine::stop() {
  const Turn turn(*this);
  component::Host::stop(owner_);
}

component::TriggerStatus Machine::send(std::size_t trigger, int arguments) {
  luaL_unref(machines_.lua(), LUA_REGISTRYINDEX, std::exchange(arguments_[trigger], arguments));
  if (!running()) return component::TriggerStatus::kNotRunning;
  const Turn turn(*this);
  component::TriggerStatus status = component::TriggerStatus::kNotRunning;
  component::Host::run(owner_, context_, [&] { status = machine_.post(trigger); });
  return status;
}

void Machine::step() {
  const Turn turn(*this);
  stepped_at_ = context_.cycle_time;
  if (next_period_ <= stepped_at_) {
    const auto passed = (stepped_at_ - next_period_) / definition_.period + 1;
    next_period_ += passed * definition_.period;
  }
  component::Host::update(owner_);
}

/// A time that came without effect, its guard being against it, is looked at in each period.
base::Time Machine::next_due() const {
  base::Time due = base::Time::max();
  if (!running()) return due;
  for (int state = machine_.current(); state != kNoState;) {
    const auto self = static_cast<std::size_t>(state);
    if (periodic_[self]) due = std::min(due, next_period_);
    for (const base::Duration after : afters_[self]) {
      const base::Time time = base::later(entered_at_[self], after);
      due = std::min(due, time > stepped_at_ ? time : next_period_);
    }
    state = definition_.table.states[self].parent;
  }
  return due;
}

// --- events --------------------------------------------------------------------------------------

void Machine::listen(lua_State* lua) {
  for (std::size_t trigger = 0; trigger < definition_.triggers.size(); ++trigger) {
    component::EventBase* const event = definition_.triggers[trigger].event;
    if (event == nullptr) continue;
    listeners_.push_back(
        internal::listen(lua, machines_.schedule().events(), *event,
                         [this, trigger](lua_State* to, const Events::Arguments& arguments) {
                           const Machines::Lua lua_of_this_turn(machines_, to);
                           const int count = push_arguments(to, arguments);
                           send(trigger, keep_arguments(to, count));
                         }));
  }
}

void Machine::stop_listening() {
  for (const Events::Id id : std::exchange(listeners_, {}))
    machines_.schedule().events().forget(id);
}

// --- actions -------------------------------------------------------------------------------------

void Machine::perform(const MachineFunction& function) {
  using Kind = MachineFunction::Kind;
  if (function.kind == Kind::kEntry)
    entered_at_[static_cast<std::size_t>(function.state)] = context_.cycle_time;
  if (function.kind == Kind::kExit) leave(function.state);
  if (function.reference != LUA_NOREF) call(function);
  if (function.kind == Kind::kEntry) enter(function.state);
}

/// After a mistake nothing is asked any more.
bool Machine::ask(const MachineFunction& function) {
  return owner_.state() == component::State::kRunning && call(function);
}

bool Machine::call(const MachineFunction& function) {
  const int arguments = function.trigger == kNoTrigger ? LUA_NOREF : arguments_[function.trigger];
  return machines_.call(*this, function.reference, arguments);
}

void Machine::enter(int state) {
  const int run = definition_.states[static_cast<std::size_t>(state)].run;
  const bool here = owner_.state() == component::State::kRunning && machine_.current() == state;
  if (run == LUA_NOREF || !here) return;
  machines_.protect(*this, [&](lua_State* lua) {
    lua_rawgeti(lua, LUA_REGISTRYINDEX, run);
    runs_[static_cast<std::size_t>(state)] =
        machines_.schedule().add(lua, 0, [this, state](lua_State* to, const std::string* mistake) {
          return run_ended(to, state, mistake);
        });
  });
}

void Machine::leave(int state) {
  const lua_State* const run = std::exchange(runs_[static_cast<std::size_t>(state)], nullptr);
  if (run != nullptr) machines_.schedule().end(run);
}

bool Machine::run_ended(lua_State* lua, int state, const std::string* mistake) {
  const Machines::Lua lua_of_this_turn(machines_, lua);
  runs_[static_cast<std::size_t>(state)] = nullptr;
  if (mistake == nullptr) {
    const std::size_t done = definition_.states[static_cast<std::size_t>(state)].done;
    if (done != kNoTrigger) send(done, LUA_NOREF);
    return true;
  }
  if (definition_.failed == kNoTrigger) return false;
  lua_pushlstring(lua, mistake->data(), mistake->size());
  return send(definition_.failed, keep_arguments(lua, 1)) == component::TriggerStatus::kTaken;
}

}  // namespace armature::lua::internal
