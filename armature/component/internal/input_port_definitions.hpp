// SPDX-License-Identifier: Apache-2.0
#pragma once

// What of an input port is not in its header: nothing of this is needed at every read.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/component/input_port.hpp"
#include "armature/component/internal/channel.hpp"

namespace armature::component {

template <typename T>
InputPort<T>::About::~About() = default;

template <typename T>
InputPort<T>::InputPort(Component& owner, std::string_view name, std::string_view doc,
                        std::string_view unit) noexcept
    : InputPortBase(owner, std::make_unique<About>(static_cast<InputPortBase&>(*this), name, doc,
                                                   unit, types::type_of<T>())),
      source_(&about().empty) {}

template <typename T>
InputPort<T>::~InputPort() = default;

template <typename T>
const void* InputPort<T>::current() const {
  return &source_->value;
}
template <typename T>
base::Time InputPort<T>::current_time() const {
  return source_->time;
}
template <typename T>
std::uint64_t InputPort<T>::current_sequence() const {
  return source_->sequence;
}

template <typename T>
void InputPort<T>::connect_source(OutputPortBase& writer, const Sample<T>& source) {
  source_ = &source;
  seen_ = source.sequence == 0 ? 0 : source.sequence - 1;
  about().writers.push_back(&writer);
  if (ages()) owner().note_aging_input();
}

template <typename T>
void InputPort<T>::disconnect(OutputPortBase& writer) {
  forget_writer(writer);
  source_ = &about().empty;
  seen_ = 0;
}

template <typename T>
void InputPort<T>::set_shape(const T& shape) {
  if constexpr (!std::is_arithmetic_v<T>) {  // which is 0 from the beginning
    about().empty.value = T(shape);
    internal::set_to_zero(type(), &about().empty.value);
  }
}

template <typename T>
void InputPort<T>::drain(internal::ChannelBase& base) {
  auto& channel = static_cast<internal::Channel<T>&>(base);
  // What is written from now on has its own message, behind those that are on their way already.
  const std::uint64_t last = channel.newest();
  while (const Sample<T>* sample = channel.pop()) {
    receive(channel, *sample);
    if (channel.last_sequence >= last) return;
  }
}

template <typename T>
std::unique_ptr<InputPortBase> InputPort<T>::twin(StandIn& owner) const {
  std::unique_ptr<InputPort> made(new InputPort(owner, name(), doc(), unit()));
  mark_twin(*made);
  made->arrived_ = [](InputPortBase& base, ExecutionContext& where) noexcept {
    static_cast<InputPort&>(base).arrived_with_care(where, [](InputPort& port, const T& value) {
      port.seen_ = port.source_->sequence;
      static_cast<StandIn&>(port.owner()).pass_on(port, &value);
    });
  };
  return made;
}

template <typename T>
std::unique_ptr<OutputPortBase> InputPort<T>::make_writer(Component& owner) const {
  std::unique_ptr<OutputPort<T>> made(new OutputPort<T>(owner, name(), doc(), unit()));
  made->apply(declared_size());
  return made;
}

template <typename T>
void InputPort<T>::receive(internal::Channel<T>& channel, const Sample<T>& sample) {
  take(channel, sample);
  ExecutionContext& where = owner().context();
  owner().run_handler(where, [this, &where] { arrived(where); });
}

template <typename T>
Reading<T> InputPort<T>::read_special() noexcept {
  if (has(kPulls)) {
    if (!std::exchange(about().looked_ahead, false)) pull();
    about().unread = false;
  }
  const Sample<T>& sample = *source_;
  const ReadStatus status = status_of(sample.sequence);
  if (status == ReadStatus::kNew) set(kZeroed, false);
  const bool stale = is_stale(sample.time);
  const bool empty = status < ReadStatus::kOld || reads_zero(stale);
  return {status, stale, empty ? about().empty.value : sample.value, sample.time};
}

template <typename T>
void InputPort<T>::arrived_with_care(ExecutionContext& where, Handle handle) noexcept {
  set(kZeroed, false);
  if (has(kAges) && (about().late || is_stale(source_->time))) check_age();
  if (!owner().admits()) return;
  pass(where, [this, handle] {
    const bool zero = reads_zero(is_stale(source_->time));
    handle(*this, zero ? about().empty.value : source_->value);
  });
}

template <typename T>
internal::Channel<T>* InputPort<T>::pull() {
  About& mine = about();
  if (mine.turns) return pull_newest();
  for (std::size_t tried = 0; tried < mine.channels.size(); ++tried) {
    auto& channel = static_cast<internal::Channel<T>&>(*mine.channels[mine.next_channel]);
    if (++mine.next_channel == mine.channels.size()) mine.next_channel = 0;
    if (const Sample<T>* sample = channel.pop()) {
      take(channel, *sample);
      return &channel;
    }
  }
  return nullptr;
}

template <typename T>
internal::Channel<T>* InputPort<T>::pull_newest() {
  internal::Channel<T>* newest = nullptr;
  for (const auto& each : about().channels) {
    auto& channel = static_cast<internal::Channel<T>&>(*each);
    const Sample<T>* const sample = channel.pop();
    if (sample == nullptr) continue;
    if (newest != nullptr && sample->time < source_->time) {
      ++about().counters.missed;
      continue;
    }
    take(channel, *sample);
    newest = &channel;
  }
  return newest;
}

template <typename T>
void InputPort<T>::take(internal::Channel<T>& channel, const Sample<T>& sample) {
  note_taken(channel, sample.sequence);
  source_ = &sample;
}

template <typename T>
void InputPort<T>::look_for_newer() {
  if (!has(kPulls) || about().looked_ahead) return;
  const internal::Channel<T>* const channel = pull();
  about().looked_ahead = channel != nullptr && channel->keeps_all();
}

}  // namespace armature::component

#include "armature/component/output_port.hpp"  // which InputPort::make_writer makes
