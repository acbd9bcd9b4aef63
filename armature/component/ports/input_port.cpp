// SPDX-License-Identifier: Apache-2.0
#include "armature/component/ports/input_port.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "armature/component/host.hpp"
#include "armature/component/internal/port_parts.hpp"
#include "armature/component/stand_in.hpp"

namespace armature::component {

namespace {

/// Every number 0, every text empty, sizes as they are.
void set_to_zero(const types::Type& type, void* value) {
  if (type.set_text != nullptr) {
    type.set_text(value, {});
  } else if (type.element != nullptr) {
    const bool vector = type.kind == types::Kind::kVector;
    const std::size_t count = vector ? type.vector_size(value) : type.count;
    auto* element = static_cast<std::byte*>(vector ? type.vector_data(value) : value);
    for (std::size_t i = 0; i < count; ++i, element += type.element->size) {
      set_to_zero(*type.element, element);
    }
  } else if (type.kind == types::Kind::kStruct) {
    for (const types::Field& field : type.fields) {
      set_to_zero(*field.type, static_cast<std::byte*>(value) + field.offset);
    }
  } else {
    std::memset(value, 0, type.size);
  }
}

}  // namespace

InputPortBase::About::About(InputPortBase& port, const PortDeclaration& declaration)
    : PortBase::About(declaration), empty(form), lost(port) {}

InputPortBase::About::~About() = default;

InputPortBase::InputPortBase(Component& owner, const PortDeclaration& declaration) noexcept
    : PortBase(owner, std::make_unique<About>(*this, declaration)), source_(about().empty_value()) {
  Host::declare(owner).inputs.push_back(this);
}

InputPortBase::~InputPortBase() {
  for (OutputPortBase* writer : about().writers) writer->forget(*this);
}

InputPortBase::About& InputPortBase::about() const {
  return static_cast<About&>(PortBase::about());
}

const LeadsTo& InputPortBase::effects() const { return about().leads_to; }

bool InputPortBase::allows_fan_in() const { return about().fan_in; }

bool InputPortBase::connected() const { return !about().writers.empty(); }

const std::vector<OutputPortBase*>& InputPortBase::writers() const { return about().writers; }

bool InputPortBase::ages() const { return about().max_age > base::Duration::zero(); }

base::Duration InputPortBase::max_age() const { return about().max_age; }

Reaction InputPortBase::stale_reaction() const { return about().stale_reaction; }

Reaction InputPortBase::lost_reaction() const { return about().lost_reaction; }

InputCounters InputPortBase::counters() const { return about().counters; }

const void* InputPortBase::current() const { return source_; }

base::Time InputPortBase::current_time() const { return about().form.time(source_); }

std::uint64_t InputPortBase::current_sequence() const { return about().form.sequence(source_); }

void InputPortBase::apply(OnLost declared) noexcept { about().lost_reaction = declared.reaction; }

void InputPortBase::apply(FanIn) noexcept { about().fan_in = true; }

void InputPortBase::apply(const LeadsTo& effects) noexcept { about().leads_to = effects; }

void InputPortBase::apply(MaxAge declared) noexcept {
  about().max_age = declared.age;
  about().stale_reaction = declared.reaction;
  set(kAges, declared.age > base::Duration::zero());
  if (ages()) Host::note_aging_input(owner());
}

void InputPortBase::apply(OnDataUpdate) noexcept {
  triggers_ = true;
  arrived_ = [](InputPortBase& port, ExecutionContext& where) noexcept {
    port.set(kZeroed, false);
    port.pass(where, [&port] { Host::update(port.owner()); });
  };
}

template <typename Code>
void InputPortBase::pass(ExecutionContext& where, Code&& code) noexcept {
  if (inside_ != 0) return refuse(where);
  inside_ = 1;
  Host::enter_handler(owner(), where, *this, outer_, code);
  inside_ = 0;
}

void InputPortBase::connect_source(OutputPortBase& writer, const void* sample) {
  source_ = sample;
  const std::uint64_t sequence = current_sequence();
  seen_ = sequence == 0 ? 0 : sequence - 1;
  about().writers.push_back(&writer);
  if (ages()) Host::note_aging_input(owner());
}

void InputPortBase::connect_channel(OutputPortBase& writer,
                                    std::unique_ptr<internal::Channel> channel) {
  channel->writer = &writer;
  about().writers.push_back(&writer);
  about().channels.push_back(std::move(channel));
  set(kPulls, !triggers_);
  if (ages()) Host::note_aging_input(owner());
}

void InputPortBase::set_shape(const void* value) {
  void* const empty = about().empty.get();
  type().assign(empty, value);
  set_to_zero(type(), empty);
}

void InputPortBase::let_writers_take_turns() { about().turns = true; }

bool InputPortBase::writers_take_turns() const { return about().turns; }

void InputPortBase::disconnect(OutputPortBase& writer) {
  forget_writer(writer);
  source_ = about().empty_value();
  seen_ = 0;
}

void InputPortBase::forget_writer(OutputPortBase& writer) {
  About& mine = about();
  std::erase(mine.writers, &writer);
  std::erase_if(mine.channels, [&writer](const auto& each) { return each->writer == &writer; });
  if (mine.writers.empty()) mine.turns = false;
  mine.next_channel = 0;
  mine.unread = false;
  mine.looked_ahead = false;
  set(kPulls, !triggers_ && !mine.channels.empty());
}

InputPortBase::Found InputPortBase::find() noexcept {
  About& mine = about();
  if (has(kPulls)) {
    if (!std::exchange(mine.looked_ahead, false)) pull();
    mine.unread = false;
  }
  const base::Time time = current_time();
  const std::uint64_t sequence = current_sequence();
  if (sequence == 0) {
    const ReadStatus status = connected() ? ReadStatus::kNone : ReadStatus::kNotConnected;
    return {status, is_stale(time), mine.empty_value(), time};
  }
  const ReadStatus status = status_of(sequence);
  if (status == ReadStatus::kNew) set(kZeroed, false);
  const bool stale = is_stale(time);
  return {status, stale, reads_zero(stale) ? mine.empty_value() : source_, time};
}

void InputPortBase::drain(internal::Channel& channel) {
  // What is written from now on has its own message, behind those that are on their way already.
  const std::uint64_t last = channel.newest();
  while (const void* sample = channel.pop()) {
    receive(channel, sample);
    if (channel.last_sequence >= last) return;
  }
}

void InputPortBase::receive(internal::Channel& channel, const void* sample) {
  take(channel, sample);
  ExecutionContext& where = Host::context(owner());
  Host::run_handler(owner(), where, [this, &where] { arrived(where); });
}

void InputPortBase::arrived_with_care(ExecutionContext& where, Handle handle) noexcept {
  set(kZeroed, false);
  if (has(kAges) && (about().late || is_stale(current_time()))) check_age();
  if (!Host::admits(owner())) return;
  pass(where, [this, handle] {
    const bool zero = reads_zero(is_stale(current_time()));
    handle(*this, zero ? about().empty_value() : source_);
  });
}

internal::Channel* InputPortBase::pull() {
  About& mine = about();
  if (mine.turns) return pull_newest();
  for (std::size_t tried = 0; tried < mine.channels.size(); ++tried) {
    internal::Channel& channel = *mine.channels[mine.next_channel];
    if (++mine.next_channel == mine.channels.size()) mine.next_channel = 0;
    if (const void* sample = channel.pop()) {
      take(channel, sample);
      return &channel;
    }
  }
  return nullptr;
}

internal::Channel* InputPortBase::pull_newest() {
  internal::Channel* newest = nullptr;
  for (const auto& channel : about().channels) {
    const void* const sample = channel->pop();
    if (sample == nullptr) continue;
    if (newest != nullptr && about().form.time(sample) < current_time()) {
      ++about().counters.missed;
      continue;
    }
    take(*channel, sample);
    newest = channel.get();
  }
  return newest;
}

void InputPortBase::take(internal::Channel& channel, const void* sample) {
  note_taken(channel, about().form.sequence(sample));
  source_ = sample;
}

void InputPortBase::note_taken(internal::Channel& channel, std::uint64_t sequence) {
  if (!triggers_ || sequence != channel.last_sequence + 1) {
    About& mine = about();
    mine.counters.missed += sequence - channel.last_sequence - (mine.unread ? 0 : 1);
    mine.unread = !triggers_;
  }
  channel.last_sequence = sequence;
  seen_ = sequence - 1;
  set(kZeroed, false);
}

void InputPortBase::look_for_newer() {
  if (!has(kPulls) || about().looked_ahead) return;
  const internal::Channel* const channel = pull();
  about().looked_ahead = channel != nullptr && channel->keeps_all();
}

void InputPortBase::count_missed(std::uint64_t count) { about().counters.missed += count; }

bool InputPortBase::is_stale(base::Time written) const {
  return has(kAges) && owner().time() - written > about().max_age;
}

bool InputPortBase::reads_zero(bool stale) const {
  return has(kZeroed) || (stale && about().stale_reaction == Reaction::kZero);
}

/// What stands for an input of a component that lives elsewhere.
class InputPortBase::Twin final : public InputPortBase {
 public:
  Twin(StandIn& owner, const InputPortBase& original)
      : InputPortBase(
            owner,
            {original.name(), original.doc(), {}, original.type(), original.about().is_small}) {
    follow_unit_of(original);
    About& mine = about();
    mine.size = original.declared_size();
    mine.may_stay_open = true;  // whoever feeds the original
    mine.fan_in = original.allows_fan_in();
    mine.leads_to = leads_to_nothing();
    triggers_ = true;
    arrived_ = [](InputPortBase& port, ExecutionContext& where) noexcept {
      port.arrived_with_care(where, [](InputPortBase& self, const void* value) {
        self.seen_ = self.current_sequence();
        static_cast<StandIn&>(self.owner()).pass_on(self, value);
      });
    };
  }
};

std::unique_ptr<InputPortBase> InputPortBase::twin(StandIn& owner) const {
  return std::make_unique<Twin>(owner, *this);
}

void InputPortBase::tell_lost() { Host::context(owner()).raise(about().lost); }

void InputPortBase::set_at_once(bool on) {
  set(kRests, !on);
  set(kAges, !on && ages());
}

void InputPortBase::forget_messages() { about().lost.lower(); }

void InputPortBase::begin() {
  set(kZeroed, false);
  if (!ages()) return;
  about().started = owner().time();
  about().late = false;
}

void InputPortBase::check_age() {
  if (!ages() || !connected() || owner().state() != State::kRunning) return;
  look_for_newer();
  About& mine = about();
  const bool was_late = std::exchange(mine.late, is_stale(written()));
  if (!mine.late || was_late) return;
  ++mine.counters.stale;
  if (mine.stale_reaction != Reaction::kZero) {
    react(mine.stale_reaction, "its data is older than declared");
  }
}

base::Time InputPortBase::written() const {
  return current_sequence() == 0 ? about().started : std::max(current_time(), about().started);
}

base::Time InputPortBase::expiry() const {
  if (!ages() || !connected() || about().late) return base::Time::max();
  return base::later(base::later(written(), about().max_age), base::Duration(1));
}

base::Time InputPortBase::age_holds_until() const {
  if (!ages() || !connected()) return base::Time::max();
  // What comes after old data, or from several writers, may change at any time how old it is.
  if (about().late || about().fan_in) return base::Time{};
  return base::later(written(), about().max_age);
}

void InputPortBase::Lost::deliver(rt::Message& message) {
  auto& lost = static_cast<Lost&>(message);
  lost.lower();
  About& about = lost.self.about();
  if (about.turns && lost.self.has_running_writer()) return;  // it was not this one's turn
  ++about.counters.lost;
  lost.self.react(about.lost_reaction, "the component that writes it is out of service");
}

bool InputPortBase::has_running_writer() const {
  const auto& writers = about().writers;
  return std::any_of(writers.begin(), writers.end(), [](const OutputPortBase* writer) {
    return writer->owner().state() >= State::kRunning;
  });
}

void InputPortBase::react(Reaction reaction, std::string_view what) {
  if (owner().state() != State::kRunning && owner().state() != State::kRunTimeError) return;
  Reason reason("input '");
  reason.append(name()).append("': ").append(what);
  switch (reaction) {
    case Reaction::kHold:
      break;
    case Reaction::kZero:
      set(kZeroed, true);
      break;
    case Reaction::kStop:
      owner().stop_because(reason);
      break;
    case Reaction::kFault:
      owner().fault(reason);
      break;
  }
}

}  // namespace armature::component
