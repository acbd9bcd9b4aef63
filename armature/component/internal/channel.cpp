// SPDX-License-Identifier: Apache-2.0
#include "armature/component/internal/channel.hpp"

#include <type_traits>
#include <utility>

#include "armature/component/host.hpp"
#include "armature/component/internal/sample_form.hpp"
#include "armature/rt/latest.hpp"
#include "armature/rt/outbox.hpp"
#include "armature/rt/passage.hpp"
#include "armature/rt/quick_latest.hpp"
#include "armature/rt/ring.hpp"

namespace armature::component::internal {

namespace {

/// The address of what a structure between threads found, nullptr if it found nothing.
template <typename S>
const void* content_of(const S* found) {
  return found == nullptr ? nullptr : found->get();
}

// The form lies behind what the reader writes, for the writer looks at it in every push.

template <typename S>
class LatestChannel final : public Channel {
 public:
  explicit LatestChannel(const Line& line)
      : Channel(line.reader, line.same_thread(), false),
        latest_(S::view(line.form, line.sample)),
        form_(line.form) {}

  rt::PushResult push(const void* sample) override {
    latest_.write(S::view(form_, sample));
    return rt::PushResult::kTaken;
  }
  const void* pop() override { return latest_.fetch() ? latest_.value().get() : nullptr; }

 private:
  rt::Latest<S> latest_;
  const SampleForm form_;
};

/// To a handler in another thread: values travel in batches, many of them as one message.
template <typename S>
class BatchedChannel final : public Channel {
 public:
  explicit BatchedChannel(const Line& line)
      : Channel(line.reader, false, false,
                &line.writing.lane_to(Host::context(line.reader.owner()))),
        passage_(S::view(line.form, line.sample)),
        form_(line.form) {
    lane().lane.reserve(sizeof(S));
  }

  rt::PushResult push(const void* sample) override {
    static_cast<void>(passage_.write(S::view(form_, sample), nullptr));
    return rt::PushResult::kTaken;
  }
  rt::PushResult send(const void* sample) override {
    LaneTo& to = lane();
    std::byte* place = nullptr;
    if (rt::Outbox::current() == &to.outbox) [[likely]]
      place = to.outbox.add(to.lane, to.reader.wakeup, *this, sizeof(S));
    if (place == nullptr) return Channel::send(sample);
    static_cast<void>(passage_.write(S::view(form_, sample), place));
    return rt::PushResult::kTaken;
  }
  const void* pop() override { return content_of(passage_.fetch()); }

 private:
  std::size_t receive(const std::byte* data) override {
    if (const S* const sample = passage_.receive(data)) {
      reader().receive(*this, sample->get());
    }
    return sizeof(S);
  }

  rt::Passage<S> passage_;
  const SampleForm form_;
};

/// To an input in another thread that looks for new values itself.
template <typename S>
class PolledChannel final : public Channel {
 public:
  explicit PolledChannel(const Line& line)
      : Channel(line.reader, false, false),
        latest_(S::view(line.form, line.sample)),
        form_(line.form) {}

  rt::PushResult push(const void* sample) override {
    latest_.write(S::view(form_, sample));
    return rt::PushResult::kTaken;
  }
  const void* pop() override { return content_of(latest_.fetch()); }

 private:
  rt::QuickLatest<S> latest_;
  const SampleForm form_;
};

template <typename S, typename Atomics>
class FifoChannel final : public Channel {
 public:
  explicit FifoChannel(const Line& line)
      : Channel(line.reader, line.same_thread(), true),
        ring_(line.policy.capacity, line.policy.when_full, S::view(line.form, line.sample)),
        form_(line.form) {}

  rt::PushResult push(const void* sample) override {
    const rt::PushResult result = ring_.push(S::view(form_, sample));
    if (result != rt::PushResult::kRefused) {
      newest_.store(form_.sequence(sample), std::memory_order_release);
    }
    return result;
  }
  const void* pop() override { return content_of(ring_.pop()); }
  std::uint64_t newest() const override { return newest_.load(std::memory_order_acquire); }

 private:
  rt::Ring<S, Atomics> ring_;
  typename Atomics::template Atomic<std::uint64_t> newest_{0};
  const SampleForm form_;
};

/// Within one thread: a sample is read in the cycle after the one in which it was written, whether
/// the reader's turn comes before the writer's or after it.
template <typename S>
class DelayChannel final : public Channel {
 public:
  explicit DelayChannel(const Line& line)
      : Channel(line.reader, false, false),
        form_(line.form),
        written_(static_cast<const S&>(S::view(line.form, line.sample))),  // a copy
        ripe_(written_),
        read_(written_) {}

  rt::PushResult push(const void* sample) override {
    if (fresh_ && written_in_ != cycle()) ripen();
    written_ = S::view(form_, sample);
    written_in_ = cycle();
    fresh_ = true;
    return rt::PushResult::kTaken;
  }
  const void* pop() override {
    if (fresh_ && written_in_ != cycle()) ripen();
    if (!is_ripe_) return nullptr;
    is_ripe_ = false;
    std::swap(read_, ripe_);
    return read_.get();
  }
  bool ripens() const override { return fresh_; }

 private:
  std::uint64_t cycle() const { return Host::context(reader().owner()).cycle; }
  void ripen() {
    std::swap(ripe_, written_);
    is_ripe_ = true;
    fresh_ = false;
  }

  const SampleForm form_;
  S written_;
  S ripe_;
  S read_;
  std::uint64_t written_in_ = 0;
  bool fresh_ = false;    ///< `written_` was written in the present cycle or the last one
  bool is_ripe_ = false;  ///< `ripe_` was not read yet
};

template <typename S>
std::unique_ptr<Channel> make_channel_of(const Line& line) {
  const bool same_thread = line.same_thread();
  if (line.policy.one_cycle_delay && same_thread) return std::make_unique<DelayChannel<S>>(line);
  if (line.policy.kind == ConnectionPolicy::Kind::kLatest) {
    if constexpr (std::is_trivially_copyable_v<S>) {
      if (!same_thread && !line.reader.triggers()) return std::make_unique<PolledChannel<S>>(line);
      if (!same_thread) return std::make_unique<BatchedChannel<S>>(line);
    }
    return std::make_unique<LatestChannel<S>>(line);
  }
  if (same_thread) return std::make_unique<FifoChannel<S, rt::PlainAtomics>>(line);
  return std::make_unique<FifoChannel<S, rt::StdAtomics>>(line);
}

}  // namespace

std::unique_ptr<Channel> make_channel(const Line& line) {
  using Made = std::unique_ptr<Channel>;
  return with_sample_of<Made>(line.form, line.is_small,
                              [&line]<typename S>() -> Made { return make_channel_of<S>(line); });
}

void Channel::tell_reader() {
  if (directly_) {
    reader_.drain(*this);
  } else {
    Host::context(reader_.owner()).raise_soon(*this);
  }
}

void Channel::deliver(rt::Message& message) {
  auto& self = static_cast<Channel&>(message);
  self.lower();
  self.reader_.drain(self);
  if (self.ripens()) {
    static_cast<rt::Signal&>(self).raise(Host::context(self.reader_.owner()).next_cycle);
  }
}

}  // namespace armature::component::internal
