// SPDX-License-Identifier: Apache-2.0
// Triggers threads as the execution engine does, until a wake-up is lost or the counts are reached.
#include <array>
#include <atomic>
#include <chrono>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <thread>
#include <vector>

#include "armature/rt/inbox.hpp"
#include "armature/rt/latest.hpp"
#include "armature/rt/wakeup.hpp"
#include "tests/stress/watchdog.hpp"

namespace armature::stress {
namespace {

/// The kernel's sleeping and waking, counted.
struct CountingParker : rt::FutexParker {
  static inline std::atomic<std::uint64_t> sleeps{0};
  static void wait(std::atomic<std::uint32_t>& word, std::uint32_t expected) {
    sleeps.fetch_add(1, std::memory_order_relaxed);
    FutexParker::wait(word, expected);
  }
};

/// A value that one thread writes, and the signal that announces it to another.
class Input final : public rt::Signal {
 public:
  Input() : BasicSignal(read) {}

  rt::Latest<std::uint64_t> value{0};
  std::atomic<std::uint64_t> seen{0};

 private:
  static void read(rt::Message& message) {
    auto& self = static_cast<Input&>(message);
    self.lower();
    self.value.fetch();
    self.seen.store(self.value.value(), std::memory_order_relaxed);
  }
};

/// One thread's inbox and what wakes it.
class Station {
 public:
  /// True if the trigger was not one with an earlier one that is still on its way.
  bool trigger(Input& input, std::uint64_t value) {
    input.value.write(value);
    if (!input.raise(inbox_)) return false;
    wakeup_.notify();
    return true;
  }

  void wait_and_deliver() {
    wakeup_.wait();
    inbox_.deliver_all();
  }

 private:
  rt::BasicWakeup<CountingParker> wakeup_;
  rt::Inbox inbox_;
};

/// Pauses of irregular length, so that triggers meet the receiver at every point of its way to
/// sleep.
class Pauses {
 public:
  explicit Pauses(std::uint64_t seed) : state_(seed) {}

  void sometimes() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    if ((state_ & 3u) != 0) return;
    for (std::uint64_t left = (state_ >> 8) & 8191u; left > 0; --left) {
      std::atomic_signal_fence(std::memory_order_seq_cst);
    }
  }

 private:
  std::uint64_t state_;
};

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Writes and triggers `count` times; returns how many triggers became messages.
std::uint64_t send(Station& receiver, Input& input, std::uint64_t count, std::uint64_t seed) {
  Pauses pauses(seed);
  std::uint64_t messages = 0;
  for (std::uint64_t value = 1; value <= count; ++value) {
    if (receiver.trigger(input, value)) ++messages;
    pauses.sometimes();
  }
  return messages;
}

/// One or two threads trigger another, which sleeps whenever there is nothing to do.
void run_triggers(std::uint64_t count, std::size_t senders) {
  const Stopwatch stopwatch;
  CountingParker::sleeps = 0;
  Station receiver;
  std::vector<Input> inputs(senders);
  const std::uint64_t each = count / senders;
  const auto all_seen = [&] {
    std::uint64_t sum = 0;
    for (const Input& input : inputs) sum += input.seen;
    return sum;
  };
  const Watchdog watchdog(all_seen, [&] {
    for (const Input& input : inputs) {
      std::printf("the receiver saw %" PRIu64 " of %" PRIu64 " triggers\n", input.seen.load(),
                  each);
    }
  });

  std::atomic<std::uint64_t> messages{0};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < senders; ++i) {
    threads.emplace_back(
        [&, i] { messages += send(receiver, inputs[i], each, 88172645463325252u + i); });
  }
  while (all_seen() < each * senders) receiver.wait_and_deliver();
  for (std::thread& thread : threads) thread.join();
  std::printf("triggers: %" PRIu64 " from %zu thread(s), %" PRIu64 " messages, %" PRIu64
              " times asleep, last value of each seen, none lost (%.1f s)\n",
              each * senders, senders, messages.load(), CountingParker::sleeps.load(),
              stopwatch.seconds());
  std::fflush(stdout);
}

/// Three threads in a ring, as sensor, controller and actuator: each waits for the one before it.
void run_cycles(std::uint64_t count) {
  const Stopwatch stopwatch;
  CountingParker::sleeps = 0;
  std::array<Station, 3> stations;
  std::array<Input, 3> inputs;

  const Watchdog watchdog([&] { return inputs[0].seen.load(); },
                          [&] {
                            std::printf("the three threads saw cycle %" PRIu64 ", %" PRIu64
                                        " and %" PRIu64 " of %" PRIu64 "\n",
                                        inputs[0].seen.load(), inputs[1].seen.load(),
                                        inputs[2].seen.load(), count);
                          });
  const auto wait_for = [&](std::size_t self, std::uint64_t cycle) {
    while (inputs[self].seen < cycle) stations[self].wait_and_deliver();
  };
  std::vector<std::thread> followers;
  for (const std::size_t self : {std::size_t{1}, std::size_t{2}}) {
    followers.emplace_back([&, self] {
      const std::size_t next = (self + 1) % stations.size();
      for (std::uint64_t cycle = 1; cycle <= count; ++cycle) {
        wait_for(self, cycle);
        stations[next].trigger(inputs[next], cycle);
      }
    });
  }
  for (std::uint64_t cycle = 1; cycle <= count; ++cycle) {
    stations[1].trigger(inputs[1], cycle);
    wait_for(0, cycle);
  }
  for (std::thread& follower : followers) follower.join();
  std::printf("cycles: %" PRIu64 " through 3 threads, %" PRIu64
              " times asleep, last value seen: %" PRIu64 ", none lost (%.1f s)\n",
              count, CountingParker::sleeps.load(), inputs[0].seen.load(), stopwatch.seconds());
}

}  // namespace
}  // namespace armature::stress

int main(int argc, char** argv) {
  if (argc != 3) {
    std::printf("usage: stress_wakeup TRIGGERS CYCLES\n");
    return 2;
  }
  const std::uint64_t triggers = std::strtoull(argv[1], nullptr, 10);
  armature::stress::run_triggers(triggers / 2, 1);
  armature::stress::run_triggers(triggers / 2, 2);
  armature::stress::run_cycles(std::strtoull(argv[2], nullptr, 10));
  return 0;
}
