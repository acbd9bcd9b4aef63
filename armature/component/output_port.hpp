// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "armature/component/input_port.hpp"
#include "armature/component/port.hpp"

namespace armature::component {

/// What losses an output saw.
struct OutputCounters {
  std::uint64_t refused = 0;     ///< values that a full FIFO did not take
  std::uint64_t dropped = 0;     ///< values that were dropped from a full FIFO to make room
  std::uint64_t wrong_size = 0;  ///< writes of a vector of another size
};

class OutputPortBase : public PortBase {
 public:
  OutputCounters counters() const { return about().counters; }
  const std::vector<InputPortBase*>& readers() const { return about().readers; }

  /// Connects `input`, which has the same type (see exec's checks), for the threads that both
  /// components are assigned to.
  /// @thread configuration only
  virtual void connect(InputPortBase& input, const ConnectionPolicy& policy) = 0;
  virtual void disconnect_all() = 0;
  /// `input` is no reader any more.
  virtual void forget(InputPortBase& input) = 0;

  /// Gives vectors their declared size; the number of elements of the current value otherwise.
  virtual void prepare() = 0;
  /// True if `input` expects vectors of the size that this port writes.
  virtual bool fits(const InputPortBase& input) const = 0;

 protected:
  struct About : PortBase::About {
    using PortBase::About::About;
    OutputCounters counters;
    std::vector<InputPortBase*> readers;
  };
  OutputPortBase(Component& owner, std::unique_ptr<About> about)
      : PortBase(owner, std::move(about)) {}

  About& about() const { return static_cast<About&>(PortBase::about()); }
};

/// Writes typed data to any number of inputs.
///
/// The written value lives in the port itself. A reader in the same thread reads it there: writing
/// costs one copy whatever the number of readers. Readers in other threads, FIFOs and delayed
/// readers each have a channel.
template <typename T>
class OutputPort final : public OutputPortBase {
  static_assert(PortData<T>, ARMATURE_INTERNAL_PORT_DATA_TEXT);

 public:
  /// Name, documentation and unit are literals. Options: size_of(property, factor).
  template <typename... Options>
  OutputPort(Component* owner, std::string name, std::string_view doc, std::string_view unit = {},
             Options... options)
      : OutputPortBase(*owner,
                       std::make_unique<About>(std::move(name), doc, unit, types::type_of<T>())) {
    (apply(options), ...);
    owner->declare().outputs.push_back(this);
  }
  ~OutputPort() override { OutputPort::disconnect_all(); }

  /// Writes `value` and runs the handlers that are to run on it in this thread.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  [[gnu::always_inline]] WriteStatus write(const T& value) noexcept {
    if constexpr (!std::is_trivially_copyable_v<T>) {
      return write_shaped(value);
    } else {
      sample_.value = value;
      return tell();
    }
  }

  /// Gives the port its shape, e.g. a vector its size, where no property declares it.
  /// @thread configuration only, before the connections are made
  void set_sample(const T& value) { sample_.value = T(value); }

  /// The value last written.
  const T& last() const { return sample_.value; }

  const void* current() const override { return &sample_.value; }
  base::Time current_time() const override { return sample_.time; }
  std::uint64_t current_sequence() const override { return sample_.sequence; }

  void prepare() override {
    if constexpr (internal::is_vector<T>) {
      if (declared_size().declared()) sample_.value.resize(declared_size().value());
    }
  }

  bool fits(const InputPortBase& input) const override {
    if constexpr (internal::is_vector<T>) {
      const PortSize& expected = input.declared_size();
      return !expected.declared() || expected.value() == sample_.value.size();
    } else {
      return true;
    }
  }

  void connect(InputPortBase& base, const ConnectionPolicy& policy) override {
    auto& input = static_cast<InputPort<T>&>(base);
    about().readers.push_back(&base);
    input.set_shape(sample_.value);
    const bool same_thread = &owner().context() == &base.owner().context();
    const bool latest = policy.kind == ConnectionPolicy::Kind::kLatest;
    if (same_thread && latest && !policy.one_cycle_delay && !base.allows_fan_in()) {
      input.connect_source(*this, sample_);
      if (base.triggers()) about().triggered.push_back(&input);
      choose_delivery();
      return;
    }
    auto& channel = input.connect_channel(*this, make_channel(input, policy, same_thread));
    channel.last_sequence = sample_.sequence;
    if (base.triggers()) {
      about().telling.push_back(&channel);
    } else {
      about().channels.push_back(&channel);
      hand_over_last(channel);
    }
    choose_delivery();
  }

  void disconnect_all() override {
    About& mine = about();
    for (InputPortBase* reader : mine.readers) {
      static_cast<InputPort<T>*>(reader)->disconnect(*this);
    }
    mine.readers.clear();
    mine.triggered.clear();
    mine.channels.clear();
    mine.telling.clear();
    choose_delivery();
  }

  void forget(InputPortBase& input) override {
    const auto leads_there = [&input](const Channel* each) { return &each->reader() == &input; };
    About& mine = about();
    std::erase(mine.readers, &input);
    std::erase(mine.triggered, &input);
    std::erase_if(mine.channels, leads_there);
    std::erase_if(mine.telling, leads_there);
    choose_delivery();
  }

 private:
  using Channel = internal::Channel<T>;
  struct About final : OutputPortBase::About {
    using OutputPortBase::About::About;
    std::vector<InputPort<T>*> triggered;  ///< readers in this thread whose handlers run now
    std::vector<Channel*> channels;
    std::vector<Channel*> telling;  ///< channels whose readers are to be told
  };

  About& about() const { return static_cast<About&>(OutputPortBase::about()); }

  /// Most ports have one handler to run, or nothing to do but to keep the value.
  void choose_delivery() {
    const About& mine = about();
    const bool by_channel = !mine.channels.empty() || !mine.telling.empty();
    only_handler_ = !by_channel && mine.triggered.size() == 1 ? mine.triggered.front() : nullptr;
    delivers_ = by_channel || !mine.triggered.empty();
    unread_ = mine.readers.empty() ? WriteStatus::kNotConnected : WriteStatus::kWritten;
  }

  std::unique_ptr<Channel> make_channel(InputPort<T>& input, const ConnectionPolicy& policy,
                                        bool same_thread) {
    if (policy.one_cycle_delay && same_thread) {
      return std::make_unique<internal::DelayChannel<T>>(input, sample_);
    }
    if (policy.kind == ConnectionPolicy::Kind::kLatest) {
      return std::make_unique<internal::LatestChannel<T>>(input, same_thread, sample_);
    }
    if (same_thread) {
      return std::make_unique<internal::FifoChannel<T, rt::PlainAtomics>>(input, true, policy,
                                                                          sample_);
    }
    return std::make_unique<internal::FifoChannel<T, rt::StdAtomics>>(input, false, policy,
                                                                      sample_);
  }

  [[gnu::noinline]] WriteStatus write_shaped(const T& value) noexcept {
    if (!types::same_shape(type(), &sample_.value, &value)) {
      ++about().counters.wrong_size;
      return WriteStatus::kWrongSize;
    }
    sample_.value = value;
    return tell();
  }

  [[gnu::always_inline]] WriteStatus tell() noexcept {
    Component& writer = owner();
    sample_.time = writer.time();
    ++sample_.sequence;
    if (only_handler_ == nullptr) return delivers_ ? deliver() : unread_;
    ExecutionContext& where = writer.context();
    if (where.measuring) [[unlikely]]
      return deliver();
    only_handler_->arrived(where);
    return WriteStatus::kWritten;
  }

  /// A value from before the connection was made is read as new, whatever the kind of connection.
  void hand_over_last(Channel& channel) {
    if (sample_.sequence == 0) return;
    --channel.last_sequence;
    channel.push(sample_);
  }

  /// Apart, so that it adds nothing to the common case.
  [[gnu::noinline]] WriteStatus deliver() noexcept {
    const About& mine = about();
    WriteStatus status = WriteStatus::kWritten;
    for (Channel* channel : mine.channels) note(channel->push(sample_), status);
    for (Channel* channel : mine.telling) {
      note(channel->push(sample_), status);
      channel->tell_reader();
    }
    for (InputPort<T>* input : mine.triggered) {
      owner().call_out(input->owner(), [&] { input->arrived(owner().context()); });
    }
    return status;
  }

  void note(rt::PushResult result, WriteStatus& status) {
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

  Sample<T> sample_{};
  InputPort<T>* only_handler_ = nullptr;  ///< all that a write has to run
  bool delivers_ = false;                 ///< a write has something to do for its readers
  WriteStatus unread_ = WriteStatus::kNotConnected;  ///< what a write that has nothing to do says
};

}  // namespace armature::component
