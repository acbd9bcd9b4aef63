// SPDX-License-Identifier: Apache-2.0
#include "armature/component/ports/output_port.hpp"

#include <utility>

#include "armature/component/host.hpp"
#include "armature/component/internal/port_parts.hpp"
#include "armature/component/internal/port_tap.hpp"
#include "armature/component/stand_in.hpp"

namespace armature::component {

OutputPortBase::About::About(const PortDeclaration& declaration, void* held_sample)
    : PortBase::About(declaration), sample(held_sample) {}

OutputPortBase::About::~About() = default;

OutputPortBase::OutputPortBase(Component& owner, const PortDeclaration& declaration,
                               void* sample) noexcept
    : PortBase(owner, std::make_unique<About>(declaration, sample)) {
  Host::declare(owner).outputs.push_back(this);
}

OutputPortBase::~OutputPortBase() { disconnect_all(); }

OutputPortBase::About& OutputPortBase::about() const {
  return static_cast<About&>(PortBase::about());
}

OutputCounters OutputPortBase::counters() const { return about().counters; }

const std::vector<InputPortBase*>& OutputPortBase::readers() const { return about().readers; }

const void* OutputPortBase::current() const { return about().sample; }

base::Time OutputPortBase::current_time() const { return about().form.time(current()); }

std::uint64_t OutputPortBase::current_sequence() const { return about().form.sequence(current()); }

void OutputPortBase::take_over_from(const OutputPortBase* writer) { about().predecessor = writer; }

const OutputPortBase* OutputPortBase::predecessor() const { return about().predecessor; }

bool OutputPortBase::is_tapped() const {
  return !about().taps.empty() || about().first_attached != nullptr;
}

void OutputPortBase::prepare() {
  const PortSize& size = declared_size();
  if (type().kind == types::Kind::kVector && size.declared()) {
    type().vector_resize(about().sample, size.value());
  }
}

bool OutputPortBase::fits(const InputPortBase& input) const {
  const PortSize& expected = input.declared_size();
  if (type().kind != types::Kind::kVector || !expected.declared()) return true;
  return expected.value() == type().vector_size(current());
}

void OutputPortBase::connect(InputPortBase& input, const ConnectionPolicy& policy) {
  input.set_shape(current());
  const internal::Line line{Host::context(owner()), input,    policy, about().form,
                            about().is_small,       current()};
  const bool latest = policy.kind == ConnectionPolicy::Kind::kLatest;
  const bool several = input.allows_fan_in() || input.writers_take_turns();
  if (line.same_thread() && latest && !policy.one_cycle_delay && !several) {
    input.connect_source(*this, current());
    add_reader(input);
  } else {
    add_reader(input, internal::make_channel(line));
  }
}

std::unique_ptr<AttachedTap> OutputPortBase::make_tap(std::size_t capacity,
                                                      const void* shape) const {
  return internal::make_port_tap(about().form, about().is_small, shape, capacity, 1);
}

WriteStatus OutputPortBase::write_from(const void* value) noexcept {
  About& mine = about();
  if (type().grows && !types::same_shape(type(), mine.sample, value)) return refuse_size();
  type().assign(mine.sample, value);
  mine.form.time(mine.sample) = owner().time();
  ++mine.form.sequence(mine.sample);
  return tell(mine.sample);
}

WriteStatus OutputPortBase::refuse_size() noexcept {
  ++about().counters.wrong_size;
  return WriteStatus::kWrongSize;
}

namespace internal {

/// Holds the sample of an output whose type is known by its description only.
struct HeldSample {
  AnySample held;
};

}  // namespace internal

/// An output of the type of another port.
class OutputPortBase::Erased final : private internal::HeldSample, public OutputPortBase {
 public:
  Erased(Component& owner, std::string_view name, const PortBase& like,
         const PortBase::About& original)
      : HeldSample{internal::AnySample(original.form)},
        OutputPortBase(owner,
                       {name, original.doc, original.unit, original.form.type(), original.is_small},
                       held.get()) {
    follow_unit_of(like);
    apply(original.size);
  }
};

std::unique_ptr<OutputPortBase> OutputPortBase::twin(StandIn& owner) const {
  return std::make_unique<Erased>(owner, name(), *this, about());
}

std::unique_ptr<OutputPortBase> InputPortBase::make_writer(Component& owner,
                                                           std::string_view name) const {
  return std::make_unique<OutputPortBase::Erased>(owner, name, *this, about());
}

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
  taps.push_back(
      internal::make_port_tap(about().form, about().is_small, current(), capacity, every));
  choose_delivery();
  return *taps.back();
}

void OutputPortBase::attach(AttachedTap& tap) {
  AttachedTap** end = &about().first_attached;
  while (*end != nullptr) end = &(*end)->next_;
  *end = &tap;
  tap.next_ = nullptr;
  choose_delivery();
}

void OutputPortBase::detach(AttachedTap& tap) {
  for (AttachedTap** place = &about().first_attached; *place != nullptr; place = &(*place)->next_) {
    if (*place != &tap) continue;
    *place = tap.next_;
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
                                std::unique_ptr<internal::Channel> made_channel) {
  const std::uint64_t sequence = current_sequence();
  internal::Channel& channel = *made_channel;
  about().readers.push_back(&input);
  input.connect_channel(*this, std::move(made_channel));
  channel.last_sequence = sequence;
  // Those without a handler first: what handlers read is to be there when they run.
  auto& channels = about().channels;
  channels.insert(input.triggers() ? channels.end() : channels.begin(), &channel);
  // A value from before the connection was made is read as new, whatever the kind of connection.
  if (!input.triggers() && sequence != 0) {
    --channel.last_sequence;
    channel.push(current());
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
  for (AttachedTap* tap = mine.first_attached; tap != nullptr; tap = tap->next_) tap->push(sample);
  for (internal::Channel* channel : mine.channels) note(channel->send(sample), status);
  for (InputPortBase* input : mine.triggered) run_measured(*input);
  return status;
}

void OutputPortBase::run_measured(InputPortBase& input) noexcept {
  Host::call_out(owner(), input.owner(), [&] { input.arrived(Host::context(owner())); });
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

}  // namespace armature::component
