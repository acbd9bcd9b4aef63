// SPDX-License-Identifier: Apache-2.0
#pragma once

// The component that is used, and what becomes of its numbers at the other side.

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "armature/ride/node.hpp"
#include "armature/ride/placeholder.hpp"
#include "armature/ride/service.hpp"
#include "waiting.hpp"

namespace kill_restart {

namespace ride = armature::ride;

/// `life` says which process it is of; `dropped`: events that its node has told to be lost so far.
struct Numbered {
  std::uint32_t life = 0;
  std::uint32_t number = 0;
  std::uint32_t dropped = 0;
};
inline void encode(ride::Encoder& to, const Numbered& event) {
  to.put(event.life);
  to.put(event.number);
  to.put(event.dropped);
}
inline bool decode(ride::Decoder& from, Numbered& event) {
  return from.take(event.life) && from.take(event.number) && from.take(event.dropped);
}
constexpr ride::Number event_number(const Numbered*) {
  return ride::number_of("event Numbered{unsigned int,unsigned int,unsigned int}");
}

inline constexpr ride::Declaration kDeclarations[] = {
    {"unsigned int echo(unsigned int)"},
    {"void never()"},  ///< is never answered
    {"void note(unsigned int,unsigned int)"},
    {"event Numbered{unsigned int,unsigned int,unsigned int}", ride::Access::kRead},
};
inline constexpr ride::Interface kCounter{"Counter", kDeclarations};
inline constexpr ride::Number kEcho = kDeclarations[0].number();
inline constexpr ride::Number kNever = kDeclarations[1].number();
inline constexpr ride::Number kNote = kDeclarations[2].number();

class Counter : public ride::Service {
 public:
  Counter() : Service(kCounter) {}
  void raise(const Numbered& event) { publish(event); }
  void forget_kept() {
    std::vector<ride::PendingReply> kept;
    const std::lock_guard lock(mutex_);
    kept.swap(kept_);
  }
  std::atomic<int> nevers{0};
  std::atomic<std::uint64_t> notes{0};

 private:
  ride::Executed execute(ride::Number operation, ride::Decoder& parameters,
                         ride::Reply& reply) override {
    std::uint32_t first = 0;
    std::uint32_t second = 0;
    if (operation == kEcho && parameters.take(first) && parameters.ended()) {
      reply.put(first);
    } else if (operation == kNever && parameters.ended()) {
      const std::lock_guard lock(mutex_);
      kept_.push_back(reply.keep());
      ++nevers;
    } else if (operation == kNote && parameters.take(first) && parameters.take(second)) {
      take_note(first, second);
      reply.done();
    } else {
      return ride::Executed::kMalformed;
    }
    return ride::Executed::kDone;
  }

  void take_note(std::uint32_t life, std::uint32_t number) {
    if (life == last_life_ && number <= last_number_) {
      fail("the command " + std::to_string(number) + " came after " + std::to_string(last_number_));
    }
    last_life_ = life;
    last_number_ = number;
    ++notes;
  }

  std::mutex mutex_;
  std::vector<ride::PendingReply> kept_;
  std::uint32_t last_life_ = 0;
  std::uint32_t last_number_ = 0;
};

class RemoteCounter : public ride::Placeholder {
 public:
  explicit RemoteCounter(ride::Peer& peer) : Placeholder(peer, "counter", kCounter) {}
  ride::Answer<std::uint32_t> echo(std::uint32_t value) {
    return request<std::uint32_t>(kEcho, "echo", {.deadline = 20s, .priority = {}}, value);
  }
  /// Ends with the connection only.
  ride::Answer<void> never() {
    return request<void>(kNever, "never", {.deadline = 24h, .priority = {}});
  }
  ride::Sent note(std::uint32_t life, std::uint32_t number) {
    return command(kNote, {}, life, number);
  }
  ride::Subscription on_numbered(std::function<void(const Numbered&)> handler) {
    return subscribe<Numbered>(std::move(handler));
  }
};

inline void serve(ride::Node& node, Counter& counter, const std::string& address) {
  if (const auto added = node.add("counter", counter); !added) fail(added.error());
  if (const auto got = node.listen(address); !got) fail(got.error());
}

/// Raises numbers until `goes_on` says no.
inline void raise_numbers(const ride::Node& node, Counter& counter, std::uint32_t life,
                          const std::function<bool()>& goes_on) {
  for (std::uint32_t number = 1; goes_on(); ++number) {
    counter.raise({life, number, static_cast<std::uint32_t>(node.statistics().events_dropped)});
    platform::sleep_until(platform::monotonic_now() + 100us);
  }
}

/// Numbers of one life rise, those that are missing were told to be dropped, and between two lives
/// the loss of the connection was told. Its functions are called by the node's thread.
class Watch {
 public:
  void take(const Numbered& event) {
    if (event.life != last_.life) {
      begin_life(event);
    } else if (event.number <= last_.number) {
      fail("an event came twice: " + std::to_string(event.number));
    }
    look_for_gaps(event);
    last_ = event;
    changes_at_last_ = changes_;
    ++taken_in_life_;
    ++taken;
  }
  void change(bool connected) {
    if (connected == connected_) fail(connected ? "told twice: back" : "told twice: lost");
    connected_ = connected;
    ++changes_;
    if (!connected) ++losses;
  }

  std::atomic<std::uint32_t> life{0};  ///< of the last event
  std::atomic<std::uint64_t> taken{0};
  std::atomic<std::uint64_t> losses{0};

 private:
  void begin_life(const Numbered& event) {
    const bool is_first = last_.life == 0;
    // Events may come before it is told that the connection is back: then it still counts as lost.
    if (!is_first && connected_ && changes_ == changes_at_last_) {
      fail("the gap between two lives was not told");
    }
    if (event.life < last_.life) fail("an event of a life that is over");
    first_ = event;
    taken_in_life_ = missing_ = 0;
    life = event.life;
  }

  /// The node counts an event as dropped some events after it was raised.
  void look_for_gaps(const Numbered& event) {
    constexpr std::uint32_t kLater = 128;
    const std::uint32_t missing = event.number - first_.number - taken_in_life_;
    if (missing > missing_) judge_at_ = event.number + kLater;
    missing_ = missing;
    if (event.number >= judge_at_ && missing_ > event.dropped - first_.dropped) {
      fail(std::to_string(missing_) + " events are missing and were not told to be dropped");
    }
  }

  Numbered first_;
  Numbered last_;
  bool connected_ = false;
  std::uint32_t taken_in_life_ = 0;
  std::uint32_t missing_ = 0;
  std::uint32_t judge_at_ = 0;
  std::uint64_t changes_ = 0;
  std::uint64_t changes_at_last_ = 0;
};

}  // namespace kill_restart
