// SPDX-License-Identifier: Apache-2.0
#pragma once

// How samples travel where reader and writer do not simply share one place in memory.

#include <cstdint>
#include <memory>

#include "armature/component/port.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/rt/latest.hpp"
#include "armature/rt/ring.hpp"

namespace armature::component {

template <PortData T>
class InputPort;

namespace internal {

/// One connection from a writer to a reader. As a signal it tells the reader's thread that there is
/// something to read.
template <PortData T>
class Channel : public rt::Signal {
 public:
  Channel(InputPort<T>& reader, bool directly)
      : rt::Signal(&Channel::deliver), reader_(reader), directly_(directly) {}
  virtual ~Channel() = default;

  /// @thread the writer's
  virtual rt::PushResult push(const Sample<T>& sample) = 0;
  /// The next sample to read, nullptr if there is none.
  /// @thread the reader's
  virtual const Sample<T>* pop() = 0;

  /// Has the reader's handler run: at once if the writer is in the same thread.
  void tell_reader() {
    if (directly_) {
      reader_.drain(*this);
    } else {
      reader_.owner().context().raise(*this);
    }
  }

  std::uint64_t last_sequence = 0;  ///< that the reader took

 private:
  static void deliver(rt::Message& message) {
    auto& self = static_cast<Channel&>(message);
    self.lower();
    self.reader_.drain(self);
  }

  InputPort<T>& reader_;
  bool directly_;
};

template <PortData T>
class LatestChannel final : public Channel<T> {
 public:
  LatestChannel(InputPort<T>& reader, bool directly, const Sample<T>& shape)
      : Channel<T>(reader, directly), latest_(shape) {}

  rt::PushResult push(const Sample<T>& sample) override {
    latest_.write(sample);
    return rt::PushResult::kTaken;
  }
  const Sample<T>* pop() override { return latest_.fetch() ? &latest_.value() : nullptr; }

 private:
  rt::Latest<Sample<T>> latest_;
};

template <PortData T, typename Atomics>
class FifoChannel final : public Channel<T> {
 public:
  FifoChannel(InputPort<T>& reader, bool directly, const ConnectionPolicy& policy,
              const Sample<T>& shape)
      : Channel<T>(reader, directly), ring_(policy.capacity, policy.when_full, shape) {}

  rt::PushResult push(const Sample<T>& sample) override { return ring_.push(sample); }
  const Sample<T>* pop() override { return ring_.pop(); }

 private:
  rt::Ring<Sample<T>, Atomics> ring_;
};

/// Within one thread: a sample is read in the cycle after the one in which it was written.
template <PortData T>
class DelayChannel final : public Channel<T> {
 public:
  DelayChannel(InputPort<T>& reader, const Sample<T>& shape)
      : Channel<T>(reader, false), reader_(reader), written_(shape), readable_(shape) {}

  rt::PushResult push(const Sample<T>& sample) override {
    written_ = sample;
    written_in_ = reader_.owner().context().cycle;
    pending_ = true;
    return rt::PushResult::kTaken;
  }
  const Sample<T>* pop() override {
    if (!pending_ || written_in_ == reader_.owner().context().cycle) return nullptr;
    pending_ = false;
    readable_ = written_;
    return &readable_;
  }

 private:
  InputPort<T>& reader_;
  Sample<T> written_;
  Sample<T> readable_;
  std::uint64_t written_in_ = 0;
  bool pending_ = false;
};

}  // namespace internal
}  // namespace armature::component
