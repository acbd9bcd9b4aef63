// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/reenactment.hpp"

#include <algorithm>
#include <utility>

#include "armature/component/interface.hpp"
#include "armature/exec/inlets.hpp"
#include "armature/inspect/items.hpp"
#include "armature/record/json.hpp"
#include "armature/replay/outside.hpp"

namespace armature::replay {

using exec::Act;
using exec::RunEnd;

bool is_of_the_end(const Act& act) {
  return act.kind == Act::Kind::kBeforeStop || act.kind == Act::Kind::kMistake ||
         act.kind == Act::Kind::kEnd;
}

namespace {

/// The input that an inlet's output `Component.Port` writes.
const component::InputPortBase* input_named(const exec::Application& application,
                                            const std::string& path) {
  const auto member = inspect::find_member(application, path);
  return member ? member.value().input : nullptr;
}

}  // namespace

bool Reenactment::cut_off() const {
  return acts_.empty() || acts_.back().act.kind != Act::Kind::kEnd;
}

bool Reenactment::is_due(const Act& act) const {
  const bool turned = due_ == DueBy::kTime || application_->turns() >= act.turn;
  return turned && application_->now() >= act.time;
}

void Reenactment::attend() {
  while (application_ != nullptr && next_ < acts_.size() && acts_[next_].act.attended &&
         is_due(acts_[next_].act)) {
    perform(acts_[next_++]);
  }
}

/// The next that is done between two stretches of the run; `attend` does the others on the way, if
/// the run comes by them.
const RecordedAct* Reenactment::take_next() {
  for (; next_ < acts_.size() && acts_[next_].act.attended; ++next_) {
    compare(acts_[next_], "this run does not come by the turn in which it was done");
  }
  return next_ < acts_.size() ? &acts_[next_] : nullptr;
}

const Act* Reenactment::next_between() const {
  const auto next = std::find_if(acts_.begin() + static_cast<std::ptrdiff_t>(next_), acts_.end(),
                                 [](const RecordedAct& one) { return !one.act.attended; });
  return next == acts_.end() ? nullptr : &next->act;
}

RunEnd Reenactment::run(exec::Application& application, base::Time until,
                        const std::function<bool()>& at_instant, const Alone* alone) {
  application_ = &application;
  RunEnd end = RunEnd::kTimeUp;
  while (true) {
    const Act* const act = next_between();
    const base::Time recorded = alone == nullptr ? base::Time::max() : alone->next();
    const base::Time limit =
        std::min({until, recorded, act == nullptr ? base::Time::max() : act->time});
    bool told_to_end = false;
    end = application.run_until(limit, [&] {
      told_to_end = at_instant && !at_instant();
      return told_to_end || (act != nullptr && is_due(*act));
    });
    if (told_to_end) break;
    const bool by_itself = end == RunEnd::kFaulted || end == RunEnd::kStoppedByReaction;
    if (!by_itself) end = RunEnd::kTimeUp;
    if (!by_itself && recorded <= application.now()) {
      alone->play(application);
      continue;
    }
    const bool reached = act != nullptr && application.now() >= act->time;
    if (!reached || (by_itself && !is_of_the_end(*act))) break;
    const RecordedAct& next = *take_next();
    if (next.act.kind == Act::Kind::kEnd) break;
    perform(next);
    ++next_;
  }
  application_ = nullptr;
  return end;
}

void Reenactment::perform(const RecordedAct& recorded) {
  auto values = values_of(recorded);
  compare(recorded, values ? perform(recorded.act, std::move(values).value()) : values.error());
}

/// @param refused  why it is refused now; empty if it is done
void Reenactment::compare(const RecordedAct& recorded, const std::string& refused) {
  if (recorded.refused.has_value() == !refused.empty()) return;
  const auto told = [](const std::string& why) {
    return why.empty() ? std::string("it is done") : "it is refused: " + why;
  };
  changed_.push_back({recorded.act, told(recorded.refused.value_or("")), told(refused)});
}

namespace {

/// Why it was refused, empty if it was not.
std::string refusal_in(const component::Outcome& outcome) {
  return outcome ? std::string() : std::string(outcome.reason());
}

template <typename T>
std::string refusal_in(const base::Result<T>& result) {
  return result ? std::string() : result.error();
}

}  // namespace

/// @return why it was refused, empty if it was not
std::string Reenactment::perform(const Act& act, std::vector<Value> values) {
  using Kind = Act::Kind;
  exec::Application& application = *application_;
  switch (act.kind) {
    case Kind::kCall:
      return refusal_in(application.call(act.component, act.item, std::move(values), act.caller));
    case Kind::kBegin: {
      auto begun = application.begin(act.component, act.item, std::move(values), act.caller);
      if (!begun) return begun.error();
      commands_.insert_or_assign(act.command, std::move(begun).value());
      return {};
    }
    case Kind::kCancel: {
      const auto command = commands_.find(act.command);
      if (command == commands_.end()) return "no such command was begun";
      command->second.cancel();
      return {};
    }
    case Kind::kSet:
      if (is_of_another_process(values.front().text())) {
        return "a replay uses no bus of another process";
      }
      return refusal_in(
          application.set_property(act.component, act.item, values.front(), act.caller));
    case Kind::kWrite:
      return write(act, values.front());
    case Kind::kStart:
      return refusal_in(application.start_component(act.component));
    case Kind::kStop:
      return refusal_in(application.stop_component(act.component));
    case Kind::kCancelStop:
      application.cancel_way_to_stop(act.component);
      return {};
    case Kind::kRecover:
      return refusal_in(application.recover_component(act.component));
    case Kind::kReset:
      return refusal_in(application.reset_component(act.component));
    case Kind::kCleanUp:
      return refusal_in(application.clean_up_component(act.component));
    case Kind::kMode:
      return refusal_in(application.switch_mode(act.item));
    case Kind::kBeforeStop:
    case Kind::kMistake: {
      const auto end = types::value_named<RunEnd>(act.item).value_or(RunEnd::kTimeUp);
      const auto leave =
          act.kind == Kind::kMistake ? exec::Leave::kAfterMistake : exec::Leave::kInOrder;
      application.run_before_stop(end, nullptr, leave);
      return {};
    }
    case Kind::kEnd:
    case Kind::kRefused:  // which no list of acts has
    case Kind::kDone:
      return {};
  }
  return {};
}

std::string Reenactment::write(const Act& act, const Value& value) {
  auto* const inlets = dynamic_cast<exec::Inlets*>(application_->find(act.component));
  const component::InputPortBase* const input = input_named(*application_, act.item);
  if (inlets == nullptr || input == nullptr || !inlets->writes(*input)) {
    return "it is not open any more";
  }
  static_cast<void>(inlets->write(*application_, *input, value));
  return {};
}

/// Of operations and commands their arguments, of what is set or written the one that it has.
base::Result<std::vector<const types::Type*>> Reenactment::types_of(const Act& act) {
  const bool of_call = act.kind == Act::Kind::kCall || act.kind == Act::Kind::kBegin;
  const bool of_value = act.kind == Act::Kind::kSet || act.kind == Act::Kind::kWrite;
  std::vector<const types::Type*> types;
  if (!of_call && !of_value) return types;
  const std::string name =
      act.kind == Act::Kind::kWrite ? act.item : act.component + '.' + act.item;
  const auto member = inspect::find_member(*application_, name);
  if (!member) return base::Error{member.error()};
  const component::OperationBase* const operation = member.value().operation;
  if (of_call && operation != nullptr) {
    for (const auto& argument : operation->signature().arguments) types.push_back(argument.type);
  } else if (of_value && operation == nullptr && member.value().has_value()) {
    types.push_back(&member.value().type());
  } else {
    return base::Error{"'" + name + (of_call ? "' cannot be called" : "' has no value to set")};
  }
  return types;
}

base::Result<std::vector<types::Value>> Reenactment::values_of(const RecordedAct& recorded) {
  const auto types = types_of(recorded.act);
  if (!types) return base::Error{types.error()};
  if (types.value().size() != recorded.values.size()) {
    return base::Error{"it takes " + std::to_string(types.value().size()) + " values now, not " +
                       std::to_string(recorded.values.size())};
  }
  std::vector<Value> values;
  for (std::size_t i = 0; i < types.value().size(); ++i) {
    Value& value = values.emplace_back(*types.value()[i]);
    const auto read = record::from_json(value.type(), recorded.values[i], value.data());
    if (read) continue;
    return base::Error{"its value " + recorded.values[i] + " does not fit: " + read.error()};
  }
  return values;
}

}  // namespace armature::replay
