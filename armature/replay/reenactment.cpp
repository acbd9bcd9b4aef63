// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/reenactment.hpp"

#include <algorithm>
#include <utility>

#include "armature/base/quoted.hpp"
#include "armature/base/seconds.hpp"
#include "armature/component/interface.hpp"
#include "armature/exec/inlets.hpp"
#include "armature/inspect/items.hpp"
#include "armature/record/json.hpp"

namespace armature::replay {

using exec::Act;
using exec::RunEnd;
using types::name_of;

namespace {

bool is_of_the_end(const Act& act) {
  return act.kind == Act::Kind::kBeforeStop || act.kind == Act::Kind::kMistake ||
         act.kind == Act::Kind::kEnd;
}

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
  return application_->now() >= act.time && application_->turns() >= act.turn;
}

void Reenactment::attend() {
  while (application_ != nullptr && next_ < acts_.size() && acts_[next_].act.attended &&
         is_due(acts_[next_].act)) {
    perform(acts_[next_++]);
  }
}

/// The next that is done between two stretches of the run; `attend` does the others on the way.
const RecordedAct* Reenactment::take_next() {
  while (next_ < acts_.size() && acts_[next_].act.attended) ++next_;
  return next_ < acts_.size() ? &acts_[next_] : nullptr;
}

const Act* Reenactment::next_between() const {
  const auto next = std::find_if(acts_.begin() + static_cast<std::ptrdiff_t>(next_), acts_.end(),
                                 [](const RecordedAct& one) { return !one.act.attended; });
  return next == acts_.end() ? nullptr : &next->act;
}

RunEnd Reenactment::run(exec::Application& application, base::Time until,
                        const std::function<bool()>& at_instant) {
  application_ = &application;
  RunEnd end = RunEnd::kTimeUp;
  while (true) {
    const Act* const act = next_between();
    const base::Time limit = act == nullptr ? until : std::min(until, act->time);
    bool told_to_end = false;
    end = application.run_until(limit, [&] {
      told_to_end = at_instant && !at_instant();
      return told_to_end || (act != nullptr && is_due(*act));
    });
    if (told_to_end) break;
    const bool by_itself = end == RunEnd::kFaulted || end == RunEnd::kStoppedByReaction;
    if (!by_itself) end = RunEnd::kTimeUp;
    const bool reached = act != nullptr && application.now() >= act->time;
    if (!reached || act->kind == Act::Kind::kEnd || (by_itself && !is_of_the_end(*act))) break;
    perform(*take_next());
    ++next_;
  }
  application_ = nullptr;
  return end;
}

void Reenactment::perform(const RecordedAct& recorded) {
  if (auto values = values_of(recorded)) perform(recorded.act, std::move(*values));
}

/// What was refused is refused again, which is no problem.
void Reenactment::perform(const Act& act, std::vector<Value> values) {
  using Kind = Act::Kind;
  exec::Application& application = *application_;
  switch (act.kind) {
    case Kind::kCall:
      static_cast<void>(application.call(act.component, act.item, std::move(values), act.caller));
      return;
    case Kind::kBegin:
      if (auto begun = application.begin(act.component, act.item, std::move(values), act.caller)) {
        commands_.insert_or_assign(act.command, std::move(begun).value());
      }
      return;
    case Kind::kCancel:
      if (const auto command = commands_.find(act.command); command != commands_.end()) {
        command->second.cancel();
      }
      return;
    case Kind::kSet:
      static_cast<void>(
          application.set_property(act.component, act.item, values.front(), act.caller));
      return;
    case Kind::kWrite:
      return write(act, values.front());
    case Kind::kStart:
      static_cast<void>(application.start_component(act.component));
      return;
    case Kind::kStop:
      static_cast<void>(application.stop_component(act.component));
      return;
    case Kind::kCancelStop:
      return application.cancel_way_to_stop(act.component);
    case Kind::kRecover:
      static_cast<void>(application.recover_component(act.component));
      return;
    case Kind::kReset:
      static_cast<void>(application.reset_component(act.component));
      return;
    case Kind::kCleanUp:
      static_cast<void>(application.clean_up_component(act.component));
      return;
    case Kind::kMode:
      static_cast<void>(application.switch_mode(act.item));
      return;
    case Kind::kBeforeStop:
    case Kind::kMistake: {
      const auto end = types::value_named<RunEnd>(act.item).value_or(RunEnd::kTimeUp);
      const auto leave =
          act.kind == Kind::kMistake ? exec::Leave::kAfterMistake : exec::Leave::kInOrder;
      application.run_before_stop(end, nullptr, leave);
      return;
    }
    case Kind::kEnd:
      return;
  }
}

void Reenactment::write(const Act& act, const Value& value) {
  auto* const inlets = dynamic_cast<exec::Inlets*>(application_->find(act.component));
  const component::InputPortBase* const input = input_named(*application_, act.item);
  if (inlets == nullptr || input == nullptr || !inlets->writes(*input)) {
    return complain(act, "it is not open any more");
  }
  static_cast<void>(inlets->write(*application_, *input, value));
}

/// Nothing if what the act is about is not there any more, which was told.
std::optional<std::vector<const types::Type*>> Reenactment::types_of(const Act& act) {
  const bool of_values = act.kind == Act::Kind::kCall || act.kind == Act::Kind::kBegin ||
                         act.kind == Act::Kind::kSet || act.kind == Act::Kind::kWrite;
  if (!of_values) return std::vector<const types::Type*>{};
  const std::string name =
      act.kind == Act::Kind::kWrite ? act.item : act.component + '.' + act.item;
  const auto member = inspect::find_member(*application_, name);
  if (!member) {
    complain(act, member.error());
    return std::nullopt;
  }
  std::vector<const types::Type*> types;
  if (const component::OperationBase* const operation = member.value().operation) {
    for (const auto& argument : operation->signature().arguments) types.push_back(argument.type);
  } else if (member.value().has_value()) {
    types.push_back(&member.value().type());
  }
  return types;
}

std::optional<std::vector<types::Value>> Reenactment::values_of(const RecordedAct& recorded) {
  const auto types = types_of(recorded.act);
  if (!types) return std::nullopt;
  if (types->size() != recorded.values.size()) {
    complain(recorded.act, "it takes " + std::to_string(types->size()) + " values now, not " +
                               std::to_string(recorded.values.size()));
    return std::nullopt;
  }
  std::vector<Value> values;
  for (std::size_t i = 0; i < types->size(); ++i) {
    Value& value = values.emplace_back(*(*types)[i]);
    const auto read = record::from_json(value.type(), recorded.values[i], value.data());
    if (read) continue;
    complain(recorded.act, "its value " + recorded.values[i] + " does not fit: " + read.error());
    return std::nullopt;
  }
  return values;
}

void Reenactment::complain(const Act& act, const std::string& why) {
  const std::string what = act.component.empty() ? act.item : act.component + '.' + act.item;
  problems_.warning({}, "at " + std::to_string(base::to_seconds(act.time.time_since_epoch())) +
                            " s " + std::string(name_of(act.kind)) + " of " + base::quoted(what) +
                            " cannot be done again: " + why);
}

}  // namespace armature::replay
