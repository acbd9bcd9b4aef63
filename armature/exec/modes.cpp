// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/modes.hpp"

#include <algorithm>
#include <utility>

#include "armature/component/host.hpp"

namespace armature::exec {

using component::Component;
using component::Outcome;
using component::Reason;
using component::State;

namespace {

bool was_started(const Component& component) { return component.state() >= State::kRunning; }

}  // namespace

void Modes::set_modes(std::vector<Mode> modes, std::size_t initial) {
  modes_ = std::move(modes);
  present_ = initial;
  std::size_t most = 0;
  for (const Mode& mode : modes_) most = std::max(most, mode.members.size());
  started_.clear();
  started_.reserve(most);
  request_.lower();  // the thread in which it may have been on its way is no more
}

void Modes::begin(base::Time now) { begun_ = now; }

Outcome Modes::on_start() {
  mode_.assign(modes_[present_].name);
  return component::accepted();
}

Outcome Modes::begin_switch(ModeName name) {
  const std::size_t target = find(name);
  if (target == modes_.size()) return unknown(name);
  if (Outcome outcome = check_ready(target); !outcome) return outcome;
  wanted_ = target;
  component::Host::context(*this).raise(request_);
  return component::accepted();
}

void Modes::Request::deliver(rt::Message& message) {
  auto& request = static_cast<Request&>(message);
  request.lower();
  request.self.carry_out();
}

void Modes::carry_out() {
  if (!switch_.active()) return;
  component::Host::run(*this, component::Host::context(*this), [this] {
    if (const Outcome outcome = go_to(wanted_); !outcome) return switch_.fail(outcome.reason());
    switch_.complete();
  });
}

Outcome Modes::switch_to(std::string_view name) {
  const std::size_t target = find(name);
  return target == modes_.size() ? unknown(name) : go_to(target);
}

std::size_t Modes::find(std::string_view name) const {
  const auto found = std::find_if(modes_.begin(), modes_.end(),
                                  [name](const Mode& mode) { return mode.name.view() == name; });
  return static_cast<std::size_t>(found - modes_.begin());
}

Outcome Modes::unknown(std::string_view name) const {
  Reason why("unknown mode '");
  why.append(name).append("', known: ");
  for (const Mode& mode : modes_) {
    why.append(&mode == &modes_.front() ? "" : ", ").append(mode.name);
  }
  return component::refused(why);
}

Outcome Modes::check_ready(std::size_t target) const {
  for (const Component* member : modes_[target].members) {
    if (member->state() >= State::kStopped) continue;
    Reason why("'");
    why.append(member->name()).append("' is in ").append(component::name_of(member->state()));
    if (!member->reason().empty()) why.append(": ").append(member->reason());
    return component::refused(why);
  }
  return component::accepted();
}

Outcome Modes::go_to(std::size_t target) {
  if (target == present_) return component::accepted();
  const Way& way = modes_[present_].ways[target];
  Outcome outcome = check_ready(target);
  if (outcome) {
    announce_successions(way, true);
    outcome = start_members(target);
    announce_successions(way, false);
  }
  if (!outcome) {
    log_warning("stays in mode {}: {}", present(), outcome.reason());
    return outcome;
  }
  for (Component* leaving : way.leaving) component::Host::stop(*leaving);
  log_info("mode {} in place of {}", modes_[target].name.view(), present());
  present_ = target;
  mode_.assign(modes_[target].name);
  switched_.raise(modes_[target].name);
  return outcome;
}

/// All of them, or none.
Outcome Modes::start_members(std::size_t target) {
  started_.clear();
  for (Component* member : modes_[target].members) {
    if (was_started(*member)) continue;
    const Outcome outcome = component::Host::start(*member);
    if (outcome) {
      started_.push_back(member);
      continue;
    }
    for (auto each = started_.rbegin(); each != started_.rend(); ++each)
      component::Host::stop(**each);
    Reason why("'");
    return component::refused(
        why.append(member->name()).append("' refuses to start: ").append(outcome.reason()));
  }
  return component::accepted();
}

/// What was written before the application started says nothing.
void Modes::announce_successions(const Way& way, bool begins) const {
  for (const Succession& each : way.successions) {
    const component::OutputPortBase& leaving = *each.leaving;
    const bool wrote = leaving.current_sequence() != 0 && leaving.current_time() >= begun_;
    each.entering->take_over_from(begins && wrote ? &leaving : nullptr);
  }
}

Outcome Modes::admit(const Component& asked) const {
  const auto has = [&asked](const Mode& mode) {
    return std::find(mode.members.begin(), mode.members.end(), &asked) != mode.members.end();
  };
  const bool switched = std::any_of(modes_.begin(), modes_.end(), has);
  if (!switched || has(modes_[present_])) return component::accepted();
  Reason why("'");
  why.append(asked.name()).append("' does not belong to the present mode '").append(present());
  return component::refused(why.append("': switch to a mode that has it"));
}

}  // namespace armature::exec
