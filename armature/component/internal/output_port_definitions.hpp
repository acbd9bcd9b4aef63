// SPDX-License-Identifier: Apache-2.0
#pragma once

// What of an output port is not in its header: nothing of this is needed at every write.

#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/component/internal/channel.hpp"
#include "armature/component/internal/port_tap.hpp"
#include "armature/component/output_port.hpp"

namespace armature::component {

template <typename T>
OutputPort<T>::OutputPort(Component& owner, std::string_view name, std::string_view doc,
                          std::string_view unit) noexcept
    : OutputPortBase(owner, std::make_unique<About>(name, doc, unit, types::type_of<T>())) {}

template <typename T>
OutputPort<T>::~OutputPort() = default;

template <typename T>
const void* OutputPort<T>::current() const {
  return &sample_.value;
}
template <typename T>
base::Time OutputPort<T>::current_time() const {
  return sample_.time;
}
template <typename T>
std::uint64_t OutputPort<T>::current_sequence() const {
  return sample_.sequence;
}

template <typename T>
void OutputPort<T>::prepare() {
  if constexpr (internal::is_vector<T>) {
    if (declared_size().declared()) sample_.value.resize(declared_size().value());
  }
}

template <typename T>
bool OutputPort<T>::fits(const InputPortBase& input) const {
  if constexpr (internal::is_vector<T>) {
    const PortSize& expected = input.declared_size();
    return !expected.declared() || expected.value() == sample_.value.size();
  } else {
    return true;
  }
}

template <typename T>
void OutputPort<T>::connect(InputPortBase& base, const ConnectionPolicy& policy) {
  auto& input = static_cast<InputPort<T>&>(base);
  input.set_shape(sample_.value);
  const bool same_thread = &owner().context() == &base.owner().context();
  const bool latest = policy.kind == ConnectionPolicy::Kind::kLatest;
  const bool several = base.allows_fan_in() || base.writers_take_turns();
  if (same_thread && latest && !policy.one_cycle_delay && !several) {
    input.connect_source(*this, sample_);
    add_reader(base);
  } else {
    add_reader(base, make_channel(base, policy, same_thread), &sample_, sample_.sequence);
  }
}

template <typename T>
std::unique_ptr<internal::ChannelBase> OutputPort<T>::make_channel(InputPortBase& input,
                                                                   const ConnectionPolicy& policy,
                                                                   bool same_thread) {
  if (policy.one_cycle_delay && same_thread) {
    return std::make_unique<internal::DelayChannel<T>>(input, sample_);
  }
  if (policy.kind == ConnectionPolicy::Kind::kLatest) {
    if constexpr (internal::is_small<T>) {
      if (!same_thread && !input.triggers()) {
        return std::make_unique<internal::PolledChannel<T>>(input, sample_);
      }
      if (!same_thread) {
        LaneTo& lane = owner().context().lane_to(input.owner().context());
        auto& reader = static_cast<InputPort<T>&>(input);
        return std::make_unique<internal::BatchedChannel<T>>(reader, lane, sample_);
      }
    }
    return std::make_unique<internal::LatestChannel<T>>(input, same_thread, sample_);
  }
  if (same_thread) {
    return std::make_unique<internal::FifoChannel<T, rt::PlainAtomics>>(input, true, policy,
                                                                        sample_);
  }
  return std::make_unique<internal::FifoChannel<T, rt::StdAtomics>>(input, false, policy, sample_);
}

template <typename T>
std::unique_ptr<internal::PortTapBase> OutputPort<T>::make_own_tap(std::size_t capacity,
                                                                   std::uint64_t every) {
  return std::make_unique<internal::PortTap<T>>(capacity, every, sample_);
}

template <typename T>
std::unique_ptr<AttachedTap> OutputPort<T>::make_tap(std::size_t capacity,
                                                     const void* shape) const {
  return std::make_unique<internal::PortTap<T>>(capacity, 1,
                                                Sample<T>{*static_cast<const T*>(shape), {}, 0});
}

template <typename T>
std::unique_ptr<OutputPortBase> OutputPort<T>::twin(StandIn& owner) const {
  std::unique_ptr<OutputPort> made(new OutputPort(owner, name(), doc(), unit()));
  made->apply(declared_size());
  return made;
}

template <typename T>
WriteStatus OutputPort<T>::write_from(const void* value) noexcept {
  return write(*static_cast<const T*>(value));
}

namespace internal {
template <typename T>
bool same_shape(const types::Type& type, const T& a, const T& b) {
  return types::same_shape(type, &a, &b);
}
/// The usual case, without a look at the type's description.
template <typename E>
requires std::is_trivially_copyable_v<E>
bool same_shape(const types::Type&, const std::vector<E>& a, const std::vector<E>& b) {
  return a.size() == b.size();
}
}  // namespace internal

template <typename T>
WriteStatus OutputPort<T>::write_shaped(const T& value) noexcept {
  if (!internal::same_shape(type(), sample_.value, value)) {
    ++about().counters.wrong_size;
    return WriteStatus::kWrongSize;
  }
  sample_.value = value;
  return tell();
}

}  // namespace armature::component
