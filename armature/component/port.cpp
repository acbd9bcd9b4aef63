// SPDX-License-Identifier: Apache-2.0
#include "armature/component/port.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "armature/component/input_port.hpp"
#include "armature/component/internal/port_tap.hpp"
#include "armature/component/output_port.hpp"

namespace armature::component {

std::string_view name_of(ReadStatus status) {
  switch (status) {
    case ReadStatus::kNotConnected:
      return "not connected";
    case ReadStatus::kNone:
      return "none";
    case ReadStatus::kOld:
      return "old";
    case ReadStatus::kNew:
      return "new";
  }
  return "unknown";
}

bool LeadsTo::includes(std::string_view name) const {
  if (!declared) return true;
  for (const std::string_view each : names) {
    if (each.empty() || name.substr(0, each.size()) != each) continue;
    // The rest may only be the number of a port in an array.
    if (name.find_first_not_of("0123456789", each.size()) == std::string_view::npos) return true;
  }
  return false;
}

PortBase::About::About(std::string_view port_name, std::string_view port_doc,
                       std::string_view port_unit, const types::Type& port_type)
    : name(port_name), type(port_type), unit(port_unit), doc(port_doc) {}

PortBase::About::~About() = default;

PortBase::PortBase(Component& owner, std::unique_ptr<About> about) noexcept
    : owner_(owner), about_(std::move(about)) {}

PortBase::~PortBase() = default;

InputPortBase::About::About(InputPortBase& port, std::string_view port_name,
                            std::string_view port_doc, std::string_view port_unit,
                            const types::Type& port_type)
    : PortBase::About(port_name, port_doc, port_unit, port_type), lost(port) {}

InputPortBase::About::~About() = default;

InputPortBase::InputPortBase(Component& owner, std::unique_ptr<About> about) noexcept
    : PortBase(owner, std::move(about)) {
  owner.declare().inputs.push_back(this);
}

InputPortBase::~InputPortBase() {
  for (OutputPortBase* writer : about().writers) writer->forget(*this);
}

void InputPortBase::apply(MaxAge declared) noexcept {
  about().max_age = declared.age;
  about().stale_reaction = declared.reaction;
  set(kAges, declared.age > base::Duration::zero());
  if (ages()) owner().note_aging_input();
}

void InputPortBase::apply(OnDataUpdate) noexcept {
  triggers_ = true;
  arrived_ = [](InputPortBase& port, ExecutionContext& where) noexcept {
    port.set(kZeroed, false);
    port.pass(where, [&port] { port.owner().update(); });
  };
}

void InputPortBase::connect_channel(OutputPortBase& writer,
                                    std::unique_ptr<internal::ChannelBase> channel) {
  channel->writer = &writer;
  about().writers.push_back(&writer);
  about().channels.push_back(std::move(channel));
  set(kPulls, !triggers_);
  if (ages()) owner().note_aging_input();
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

void InputPortBase::note_taken(internal::ChannelBase& channel, std::uint64_t sequence) {
  if (!triggers_ || sequence != channel.last_sequence + 1) {
    About& mine = about();
    mine.counters.missed += sequence - channel.last_sequence - (mine.unread ? 0 : 1);
    mine.unread = !triggers_;
  }
  channel.last_sequence = sequence;
  seen_ = sequence - 1;
  set(kZeroed, false);
}

void InputPortBase::mark_twin(InputPortBase& twin) const {
  About& its = twin.about();
  its.size = declared_size();
  its.may_stay_open = true;  // whoever feeds the original
  its.fan_in = allows_fan_in();
  its.leads_to = leads_to_nothing();
  twin.triggers_ = true;
}

OutputPortBase::About::~About() = default;

OutputPortBase::OutputPortBase(Component& owner, std::unique_ptr<About> about) noexcept
    : PortBase(owner, std::move(about)) {
  owner.declare().outputs.push_back(this);
}

OutputPortBase::~OutputPortBase() { disconnect_all(); }

void OutputPortBase::disconnect_all() {
  About& mine = about();
  for (InputPortBase* reader : mine.readers) reader->disconnect(*this);
  mine.readers.clear();
  mine.triggered.clear();
  mine.channels.clear();
  mine.taps.clear();
  choose_delivery();
}

Tap& OutputPortBase::tap(std::size_t capacity, std::uint64_t every) {
  auto& taps = about().taps;
  taps.push_back(make_own_tap(capacity, every));
  choose_delivery();
  return *taps.back();
}

void OutputPortBase::attach(AttachedTap& tap) {
  AttachedTap** end = &about().first_attached;
  while (*end != nullptr) end = &(*end)->next;
  *end = &tap;
  tap.next = nullptr;
  choose_delivery();
}

void OutputPortBase::detach(AttachedTap& tap) {
  for (AttachedTap** place = &about().first_attached; *place != nullptr; place = &(*place)->next) {
    if (*place != &tap) continue;
    *place = tap.next;
    break;
  }
  choose_delivery();
}

void OutputPortBase::forget(InputPortBase& input) {
  const auto leads_there = [&input](const auto* each) { return &each->reader() == &input; };
  About& mine = about();
  std::erase(mine.readers, &input);
  std::erase(mine.triggered, &input);
  std::erase_if(mine.channels, leads_there);
  choose_delivery();
}

void OutputPortBase::add_reader(InputPortBase& input) {
  about().readers.push_back(&input);
  if (input.triggers()) about().triggered.push_back(&input);
  choose_delivery();
}

void OutputPortBase::add_reader(InputPortBase& input,
                                std::unique_ptr<internal::ChannelBase> made_channel,
                                const void* sample, std::uint64_t sequence) {
  internal::ChannelBase& channel = *made_channel;
  about().readers.push_back(&input);
  input.connect_channel(*this, std::move(made_channel));
  channel.last_sequence = sequence;
  // Those without a handler first: what handlers read is to be there when they run.
  auto& channels = about().channels;
  channels.insert(input.triggers() ? channels.end() : channels.begin(), &channel);
  // A value from before the connection was made is read as new, whatever the kind of connection.
  if (!input.triggers() && sequence != 0) {
    --channel.last_sequence;
    channel.push(sample);
  }
  choose_delivery();
}

/// Most ports have one handler to run or one channel, or nothing to do but to keep the value.
void OutputPortBase::choose_delivery() {
  const About& mine = about();
  only_ = {};
  if (is_tapped() || mine.channels.size() + mine.triggered.size() > 1) {
    delivery_ = Delivery::kSeveral;
  } else if (!mine.triggered.empty()) {
    delivery_ = Delivery::kHandler;
    only_.handler = mine.triggered.front();
  } else if (!mine.channels.empty()) {
    delivery_ = Delivery::kChannel;
    only_.channel = mine.channels.front();
  } else {
    delivery_ = Delivery::kNothing;
  }
  unread_ = mine.readers.empty() ? WriteStatus::kNotConnected : WriteStatus::kWritten;
}

WriteStatus OutputPortBase::deliver(const void* sample) noexcept {
  WriteStatus status = unread_;
  if (delivery_ == Delivery::kChannel) {
    note(only_.channel->send(sample), status);
    return status;
  }
  const About& mine = about();
  // First, since a handler may have this port written again.
  for (const auto& tap : mine.taps) tap->push(sample);
  for (AttachedTap* tap = mine.first_attached; tap != nullptr; tap = tap->next) tap->push(sample);
  for (internal::ChannelBase* channel : mine.channels) note(channel->send(sample), status);
  for (InputPortBase* input : mine.triggered) run_measured(*input);
  return status;
}

void OutputPortBase::run_measured(InputPortBase& input) noexcept {
  owner().call_out(input.owner(), [&] { input.arrived(owner().context()); });
}

void OutputPortBase::note(rt::PushResult result, WriteStatus& status) {
  if (result == rt::PushResult::kTaken) [[likely]]
    return;
  if (result == rt::PushResult::kRefused) {
    ++about().counters.refused;
    status = WriteStatus::kFull;
  } else {
    ++about().counters.dropped;
    if (status != WriteStatus::kFull) status = WriteStatus::kDropped;
  }
}

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

namespace internal {

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

}  // namespace internal
}  // namespace armature::component
