// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/feed.hpp"

#include <atomic>
#include <cstring>
#include <utility>

namespace armature::remote {

/// Arguments of events are trivially copyable: they go as bytes, one behind the other.
class EventFeed::Tap final : public component::EventTap {
 public:
  explicit Tap(const component::Signature& signature) {
    std::size_t size = 0;
    for (const component::Signature::Argument& argument : signature.arguments) {
      const std::size_t alignment = argument.type->alignment;
      size = (size + alignment - 1) / alignment * alignment;
      places_.push_back({size, argument.type->size});
      size += argument.type->size;
    }
    event_.resize(size);
    arguments_.resize(places_.size() + 1);  // there is a place for it without arguments, too
    ring_ = std::make_unique<rt::Ring<Bytes>>(kFeedCapacity, rt::WhenFull::kDropNewest, event_);
  }

  void event_raised(const void* const* arguments) noexcept override {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      std::memcpy(event_.data() + places_[i].offset, arguments[i], places_[i].size);
    }
    if (ring_->push(event_) == rt::PushResult::kTaken) return;
    dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }

  /// The arguments of the oldest that waits, until the next call; nullptr if none does.
  const void* const* take() {
    const Bytes* const event = ring_->pop();
    if (event == nullptr) return nullptr;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      arguments_[i] = event->data() + places_[i].offset;
    }
    return arguments_.data();
  }
  std::uint64_t take_dropped() {
    const std::uint64_t dropped = dropped_.load(std::memory_order_relaxed);
    return dropped - std::exchange(told_, dropped);
  }

 private:
  using Bytes = std::vector<std::byte>;
  struct Place {
    std::size_t offset;
    std::size_t size;
  };

  std::vector<Place> places_;
  Bytes event_;  ///< of the raiser's thread
  std::unique_ptr<rt::Ring<Bytes>> ring_;
  std::atomic<std::uint64_t> dropped_{0};
  std::uint64_t told_ = 0;
  std::vector<const void*> arguments_;
};

EventFeed::EventFeed(component::EventBase& event, RunInThread run)
    : Feed(std::move(run)), event_(event) {}

EventFeed::~EventFeed() { close(); }

void EventFeed::open() {
  if (attached()) return;
  if (tap_ == nullptr) tap_ = std::make_unique<Tap>(event_.signature());
  set_attached(run(event_.owner(), [&event = event_, tap = tap_.get()] { event.add_tap(*tap); }));
  if (!attached()) static_cast<void>(tap_.release());  // it may still come to it
}

void EventFeed::close() {
  if (!attached()) return;
  set_attached(false);
  const auto remove = [&event = event_, tap = tap_.get()] { event.remove_tap(*tap); };
  if (!run(event_.owner(), remove)) static_cast<void>(tap_.release());
}

void EventFeed::take(const std::function<void(const void* const*)>& use) {
  if (tap_ == nullptr) return;
  for (std::size_t i = 0; i < kFeedCapacity; ++i) {
    const void* const* const arguments = tap_->take();
    if (arguments == nullptr) return;
    use(arguments);
  }
}

std::uint64_t EventFeed::take_dropped() { return tap_ == nullptr ? 0 : tap_->take_dropped(); }

PortFeed::PortFeed(component::OutputPortBase& port, RunInThread run)
    : Feed(std::move(run)), port_(port), value_(port.type()) {}

PortFeed::~PortFeed() { close(); }

bool PortFeed::look(std::function<void()> also) {
  struct Seen {
    explicit Seen(const types::Type& type) : value(type) {}
    types::Value value;
    std::uint64_t sequence = 0;
    base::Time time{};
  };
  // Shared: a thread that answers too late still writes to it.
  const auto seen = std::make_shared<Seen>(port_.type());
  if (present_ != nullptr) seen->value = present_->value;
  const bool answered = run(port_.owner(), [seen, &port = port_, also = std::move(also)] {
    port.type().assign(seen->value.data(), port.current());
    seen->sequence = port.current_sequence();
    seen->time = port.current_time();
    if (also) also();
  });
  if (!answered) return false;
  present_ = std::make_unique<Present>(Present{std::move(seen->value), seen->sequence, seen->time});
  return true;
}

void PortFeed::open() {
  if (attached()) {
    static_cast<void>(look({}));
    return;
  }
  if (!look({})) return;  // the shape of what it writes
  tap_ = port_.make_tap(kFeedCapacity, present_->value.data());
  told_ = 0;
  set_attached(look([&port = port_, tap = tap_.get()] { port.attach(*tap); }));
  if (!attached()) static_cast<void>(tap_.release());  // it may still come to it
}

void PortFeed::close() {
  if (!attached()) return;
  set_attached(false);
  const auto detach = [&port = port_, tap = tap_.get()] { port.detach(*tap); };
  if (!run(port_.owner(), detach)) static_cast<void>(tap_.release());
}

void PortFeed::take(
    const std::function<void(const component::TappedSample&, const void* value)>& use) {
  if (tap_ == nullptr) return;
  for (std::size_t i = 0; i < kFeedCapacity && tap_->take(sample_); ++i) {
    const auto decoded =
        types::decode(value_.type(), sample_.value.data(), sample_.value.size(), value_.data());
    if (decoded) use(sample_, value_.data());
  }
}

std::uint64_t PortFeed::take_dropped() {
  if (tap_ == nullptr) return 0;
  const std::uint64_t dropped = tap_->dropped();
  return dropped - std::exchange(told_, dropped);
}

}  // namespace armature::remote
