// SPDX-License-Identifier: Apache-2.0
#pragma once

// How samples travel where reader and writer do not simply share one place in memory. Included by
// input_port.hpp, behind what it declares.

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "armature/component/port.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/rt/lane.hpp"
#include "armature/rt/latest.hpp"
#include "armature/rt/outbox.hpp"
#include "armature/rt/passage.hpp"
#include "armature/rt/quick_latest.hpp"
#include "armature/rt/ring.hpp"

namespace armature::component {

namespace internal {

/// One connection from a writer to a reader. As a signal it tells the reader's thread that there is
/// something to read.
class alignas(rt::kCacheLine) ChannelBase : protected rt::Recipient, public rt::Signal {
 public:
  /// @param directly   reader and writer share a thread
  /// @param keeps_all  a FIFO: each value counts, not only the newest
  /// @param lane       for samples that travel in batches
  ChannelBase(InputPortBase& reader, bool directly, bool keeps_all, LaneTo* lane = nullptr)
      : rt::Signal(&ChannelBase::deliver),
        directly_(directly),
        tells_(reader.triggers()),
        keeps_all_(keeps_all),
        reader_(reader),
        lane_(lane) {}
  virtual ~ChannelBase() = default;

  InputPortBase& reader() const { return reader_; }
  bool keeps_all() const { return keeps_all_; }

  /// @param sample  a `Sample` of the ports' type
  /// @thread the writer's
  virtual rt::PushResult push(const void* sample) = 0;
  /// The number of the newest sample that is certain to be there; 0: of those written so far only
  /// one is kept.
  /// @thread any
  virtual std::uint64_t newest() const { return 0; }
  /// There will be a sample to read in the next cycle.
  virtual bool ripens() const { return false; }

  /// Pushes and has the reader's handler run, if it has one: at once if the writer is in the same
  /// thread.
  /// @thread the writer's
  virtual rt::PushResult send(const void* sample) {
    const rt::PushResult result = push(sample);
    if (tells_) tell_reader();
    return result;
  }

  const void* writer = nullptr;  ///< the port at the other end

 protected:
  LaneTo& lane() const { return *lane_; }
  void tell_reader();
  std::size_t receive(const std::byte*) override { return 0; }

 private:
  static void deliver(rt::Message& message);

  bool directly_;
  bool tells_;
  bool keeps_all_;
  InputPortBase& reader_;
  LaneTo* lane_;

 public:
  /// That the reader took. From here on the reader writes; at what is above both only look, as long
  /// as no signal is needed. On one cache line each would wait for the other at every sample.
  alignas(rt::kCacheLine) std::uint64_t last_sequence = 0;
};

template <typename T>
class Channel : public ChannelBase {
 public:
  using ChannelBase::ChannelBase;
  /// The next sample to read, nullptr if there is none.
  /// @thread the reader's
  virtual const Sample<T>* pop() = 0;

 protected:
  static const Sample<T>& as_sample(const void* sample) {
    return *static_cast<const Sample<T>*>(sample);
  }
};

template <typename T>
class LatestChannel final : public Channel<T> {
 public:
  LatestChannel(InputPortBase& reader, bool directly, const Sample<T>& shape)
      : Channel<T>(reader, directly, false), latest_(shape) {}

  rt::PushResult push(const void* sample) override {
    latest_.write(this->as_sample(sample));
    return rt::PushResult::kTaken;
  }
  const Sample<T>* pop() override { return latest_.fetch() ? &latest_.value() : nullptr; }

 private:
  rt::Latest<Sample<T>> latest_;
};

/// To a handler in another thread: values travel in batches, many of them as one message.
template <typename T>
class BatchedChannel final : public Channel<T> {
 public:
  BatchedChannel(InputPort<T>& reader, LaneTo& lane, const Sample<T>& shape)
      : Channel<T>(reader, false, false, &lane), passage_(shape) {
    lane.lane.reserve(sizeof(Sample<T>));
  }

  rt::PushResult push(const void* sample) override {
    static_cast<void>(passage_.write(this->as_sample(sample), nullptr));
    return rt::PushResult::kTaken;
  }
  rt::PushResult send(const void* sample) override {
    LaneTo& to = this->lane();
    std::byte* place = nullptr;
    if (rt::Outbox::current() == &to.outbox) [[likely]]
      place = to.outbox.add(to.lane, to.reader.wakeup, *this, sizeof(Sample<T>));
    if (place == nullptr) return ChannelBase::send(sample);
    static_cast<void>(passage_.write(this->as_sample(sample), place));
    return rt::PushResult::kTaken;
  }
  const Sample<T>* pop() override { return passage_.fetch(); }

 private:
  std::size_t receive(const std::byte* data) override {
    if (const Sample<T>* const sample = passage_.receive(data)) {
      static_cast<InputPort<T>&>(this->reader()).receive(*this, *sample);
    }
    return sizeof(Sample<T>);
  }

  rt::Passage<Sample<T>> passage_;
};

/// To an input in another thread that looks for new values itself.
template <typename T>
class PolledChannel final : public Channel<T> {
 public:
  PolledChannel(InputPortBase& reader, const Sample<T>& shape)
      : Channel<T>(reader, false, false), latest_(shape) {}

  rt::PushResult push(const void* sample) override {
    latest_.write(this->as_sample(sample));
    return rt::PushResult::kTaken;
  }
  const Sample<T>* pop() override { return latest_.fetch(); }

 private:
  rt::QuickLatest<Sample<T>> latest_;
};

template <typename T, typename Atomics>
class FifoChannel final : public Channel<T> {
 public:
  FifoChannel(InputPortBase& reader, bool directly, const ConnectionPolicy& policy,
              const Sample<T>& shape)
      : Channel<T>(reader, directly, true), ring_(policy.capacity, policy.when_full, shape) {}

  rt::PushResult push(const void* sample) override {
    const rt::PushResult result = ring_.push(this->as_sample(sample));
    if (result != rt::PushResult::kRefused) {
      newest_.store(this->as_sample(sample).sequence, std::memory_order_release);
    }
    return result;
  }
  const Sample<T>* pop() override { return ring_.pop(); }
  std::uint64_t newest() const override { return newest_.load(std::memory_order_acquire); }

 private:
  rt::Ring<Sample<T>, Atomics> ring_;
  typename Atomics::template Atomic<std::uint64_t> newest_{0};
};

/// Within one thread: a sample is read in the cycle after the one in which it was written, whether
/// the reader's turn comes before the writer's or after it.
template <typename T>
class DelayChannel final : public Channel<T> {
 public:
  DelayChannel(InputPortBase& reader, const Sample<T>& shape)
      : Channel<T>(reader, false, false), written_(shape), ripe_(shape), read_(shape) {}

  rt::PushResult push(const void* sample) override {
    if (fresh_ && written_in_ != cycle()) ripen();
    written_ = this->as_sample(sample);
    written_in_ = cycle();
    fresh_ = true;
    return rt::PushResult::kTaken;
  }
  const Sample<T>* pop() override {
    if (fresh_ && written_in_ != cycle()) ripen();
    if (!is_ripe_) return nullptr;
    is_ripe_ = false;
    std::swap(read_, ripe_);
    return &read_;
  }
  bool ripens() const override { return fresh_; }

 private:
  std::uint64_t cycle() const { return this->reader().owner().context().cycle; }
  void ripen() {
    std::swap(ripe_, written_);
    is_ripe_ = true;
    fresh_ = false;
  }

  Sample<T> written_;
  Sample<T> ripe_;
  Sample<T> read_;
  std::uint64_t written_in_ = 0;
  bool fresh_ = false;    ///< `written_` was written in the present cycle or the last one
  bool is_ripe_ = false;  ///< `ripe_` was not read yet
};

}  // namespace internal
}  // namespace armature::component
