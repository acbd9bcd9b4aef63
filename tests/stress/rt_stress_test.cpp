// SPDX-License-Identifier: Apache-2.0
// The structures of armature/rt between real threads, checked against their specifications. No test
// depends on how fast or in which order the threads run.
#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "armature/rt/inbox.hpp"
#include "armature/rt/lane.hpp"
#include "armature/rt/latest.hpp"
#include "armature/rt/log.hpp"
#include "armature/rt/passage.hpp"
#include "armature/rt/quick_latest.hpp"
#include "armature/rt/ring.hpp"
#include "armature/rt/statistics.hpp"
#include "armature/rt/wakeup.hpp"

namespace armature::rt {
namespace {

constexpr bool kSanitized = std::string_view(ARMATURE_SANITIZER) != "";
constexpr std::uint64_t kRounds = kSanitized ? 200'000 : 3'000'000;

/// Larger than a cache line, so that a torn copy shows.
struct Block {
  std::array<std::uint64_t, 16> words{};

  explicit Block(std::uint64_t value) { words.fill(value); }
  std::uint64_t value() const { return words[0]; }
  bool whole() const {
    return std::all_of(words.begin(), words.end(), [&](auto word) { return word == words[0]; });
  }
};

TEST(LatestStress, ValuesAreWholeAndNeverGoBack) {
  Latest<Block> latest(Block(0));
  std::thread writer([&] {
    for (std::uint64_t value = 1; value <= kRounds; ++value) latest.write(Block(value));
  });
  std::uint64_t seen = 0;
  bool whole = true;
  bool forward = true;
  while (seen < kRounds) {
    const bool moved = latest.fetch();
    whole = whole && latest.value().whole();
    forward = forward && (moved ? latest.value().value() > seen : latest.value().value() == seen);
    seen = latest.value().value();
    if (!moved) std::this_thread::yield();
  }
  writer.join();
  EXPECT_TRUE(whole);
  EXPECT_TRUE(forward);
  EXPECT_FALSE(latest.fetch());
}

/// As Block, with the number that samples have.
struct NumberedBlock : Block {
  explicit NumberedBlock(std::uint64_t value = 0) : Block(value), sequence(value) {}
  std::uint64_t sequence;
};

TEST(QuickLatestStress, ValuesAreWholeAndNeverGoBack) {
  QuickLatest<NumberedBlock> latest(NumberedBlock(0));
  std::thread writer([&] {
    for (std::uint64_t value = 1; value <= kRounds; ++value) latest.write(NumberedBlock(value));
  });
  std::uint64_t seen = 0;
  bool whole = true;
  bool forward = true;
  while (seen < kRounds) {
    if (const NumberedBlock* const found = latest.fetch()) {
      whole = whole && found->whole();
      forward = forward && found->value() > seen;
      seen = found->value();
    } else {
      std::this_thread::yield();
    }
  }
  writer.join();
  EXPECT_TRUE(whole);
  EXPECT_TRUE(forward);
  EXPECT_EQ(latest.fetch(), nullptr);
}

/// A connection of which values come in batches or, while none is free, by a signal.
class Connection final : public Recipient, public Signal {
 public:
  Connection(Lane& lane, Inbox& inbox) : Signal(&Connection::deliver), lane_(lane), inbox_(inbox) {}

  void write(std::uint64_t value) {
    const NumberedBlock block(value);
    if (passage_.write(block, lane_.add(*this, sizeof block))) return;
    lane_.send();
    raise(inbox_);
  }

  std::uint64_t seen = 0;
  bool whole = true;
  bool forward = true;

 private:
  std::size_t receive(const std::byte* data) override {
    take(passage_.receive(data));
    return sizeof(NumberedBlock);
  }
  static void deliver(Message& message) {
    auto& self = static_cast<Connection&>(message);
    self.lower();
    self.take(self.passage_.fetch());
  }
  void take(const NumberedBlock* block) {
    if (block == nullptr) return;
    whole = whole && block->whole();
    forward = forward && block->value() > seen;
    seen = block->value();
  }

  Lane& lane_;
  Inbox& inbox_;
  Passage<NumberedBlock> passage_{NumberedBlock(0)};
};

TEST(LaneStress, ValuesAreWholeNeverGoBackAndTheLastComes) {
  Inbox inbox;
  Lane lane(inbox);
  Connection one(lane, inbox);
  Connection two(lane, inbox);
  for (int i = 0; i < 4; ++i) lane.reserve(sizeof(NumberedBlock));
  lane.prepare();
  Wakeup wakeup;
  std::thread writer([&] {
    for (std::uint64_t value = 1; value <= kRounds / 2; ++value) {
      one.write(value);
      if (value % 3 == 0) lane.send();
      two.write(value);
      if (value % 2 == 0) lane.send();
      wakeup.notify();
    }
    lane.send();
    wakeup.notify();
  });
  while (one.seen < kRounds / 2 || two.seen < kRounds / 2) {
    wakeup.wait();
    inbox.deliver_all();
  }
  writer.join();
  for (const Connection* each : {&one, &two}) {
    EXPECT_TRUE(each->whole);
    EXPECT_TRUE(each->forward);
  }
}

class RingStress : public ::testing::TestWithParam<std::size_t> {};

TEST_P(RingStress, WhatIsRefusedOrDroppedIsAllThatIsMissing) {
  for (const WhenFull when_full : {WhenFull::kDropNewest, WhenFull::kDropOldest}) {
    Ring<Block> ring(GetParam(), when_full, Block(0));
    std::uint64_t lost = 0;
    std::atomic<bool> finished{false};
    std::thread writer([&] {
      for (std::uint64_t value = 1; value <= kRounds; ++value) {
        if (ring.push(Block(value)) != PushResult::kTaken) ++lost;
      }
      finished = true;
    });
    std::uint64_t received = 0;
    std::uint64_t last = 0;
    bool whole = true;
    bool in_order = true;
    for (bool last_look = false; !last_look;) {
      last_look = finished;
      while (const Block* block = ring.pop()) {
        ++received;
        whole = whole && block->whole();
        in_order = in_order && block->value() > last;
        last = block->value();
      }
      std::this_thread::yield();
    }
    writer.join();
    EXPECT_TRUE(whole);
    EXPECT_TRUE(in_order);
    EXPECT_EQ(received + lost, kRounds);
    if (when_full == WhenFull::kDropOldest) {
      EXPECT_EQ(last, kRounds);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Capacities, RingStress, ::testing::Values(1, 2, 3, 64));

struct Letter final : Message {
  Letter() : BasicMessage(collect) {}
  static void collect(Message& message) {
    auto& self = static_cast<Letter&>(message);
    self.received = self.sent;
    self.on_its_way.store(false, std::memory_order_release);
  }

  std::uint64_t sent = 0;
  std::uint64_t received = 0;
  std::atomic<bool> on_its_way{false};
};

TEST(InboxStress, EverySenderGetsEachMessageThrough) {
  constexpr std::uint64_t kEach = kRounds / 10;
  Inbox inbox;
  std::array<Letter, 3> letters;
  std::atomic<int> senders{3};
  std::vector<std::thread> threads;
  for (Letter& letter : letters) {
    threads.emplace_back([&] {
      for (std::uint64_t number = 1; number <= kEach; ++number) {
        letter.sent = number;
        letter.on_its_way.store(true, std::memory_order_relaxed);
        inbox.push(letter);
        while (letter.on_its_way.load(std::memory_order_acquire)) std::this_thread::yield();
        EXPECT_EQ(letter.received, number);
      }
      --senders;
    });
  }
  while (senders > 0) {
    inbox.deliver_all();
    std::this_thread::yield();
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(inbox.empty());
}

struct Bell final : Signal {
  Bell() : BasicSignal(look) {}
  static void look(Message& message) {
    auto& self = static_cast<Bell&>(message);
    self.lower();
    self.seen = self.value.load(std::memory_order_relaxed);
  }

  std::atomic<std::uint64_t> value{0};
  std::uint64_t seen = 0;
};

TEST(SignalStress, TheLastValueOfEverySenderIsSeenAndNothingIsLeft) {
  Inbox inbox;
  std::array<Bell, 2> bells;
  std::vector<std::thread> threads;
  for (Bell& bell : bells) {
    threads.emplace_back([&] {
      for (std::uint64_t value = 1; value <= kRounds; ++value) {
        bell.value.store(value, std::memory_order_relaxed);
        bell.raise(inbox);
      }
    });
  }
  while (bells[0].seen < kRounds || bells[1].seen < kRounds) inbox.deliver_all();
  for (std::thread& thread : threads) thread.join();
  inbox.deliver_all();
  EXPECT_TRUE(inbox.empty());
}

TEST(WakeupStress, TwoThreadsWakeEachOther) {
  constexpr std::uint64_t kTurns = kRounds / 50;
  Wakeup ping, pong;
  std::uint64_t turns = 0;  // belongs to whoever was woken last
  std::thread other([&] {
    for (std::uint64_t i = 0; i < kTurns; ++i) {
      ping.wait();
      ++turns;
      pong.notify();
    }
  });
  for (std::uint64_t i = 0; i < kTurns; ++i) {
    ++turns;
    ping.notify();
    pong.wait();
  }
  other.join();
  EXPECT_EQ(turns, 2 * kTurns);
}

TEST(LogQueueStress, EveryRecordIsPrintedOrCountedAsDropped) {
  LogQueue queue(8);
  std::atomic<bool> finished{false};
  std::thread thread([&] {
    LogRecord record;
    for (std::uint64_t i = 0; i < kRounds / 10; ++i) {
      record.take({rt::LogArgument(i)});
      queue.push(record);
    }
    finished = true;
  });
  std::uint64_t printed = 0;
  for (bool last_look = false; !last_look;) {
    last_look = finished;
    while (queue.pop() != nullptr) ++printed;
    std::this_thread::yield();
  }
  thread.join();
  EXPECT_EQ(printed + queue.dropped(), kRounds / 10);
}

TEST(DistributionStress, WhoeverSeesTheFirstValueSeesTheExtremesToo) {
  constexpr std::size_t kDistributions = kSanitized ? 200 : 1500;
  constexpr std::uint64_t kValue = std::uint64_t{1} << 63;  // counted in the bucket looked at last
  std::vector<Distribution> distributions(kDistributions);
  std::atomic<std::size_t> looked_at{0};
  std::thread adder([&] {
    for (std::size_t i = 0; i < kDistributions; ++i) {
      while (looked_at <= i) std::this_thread::yield();
      distributions[i].add(kValue);
    }
  });
  bool right = true;
  for (const Distribution& distribution : distributions) {
    ++looked_at;
    DistributionSummary summary;
    for (int looks = 1; summary.count == 0; ++looks) {
      summary = distribution.summary();
      if (looks % 2048 == 0) std::this_thread::yield();
    }
    right = right && summary.least == kValue && summary.most == kValue;
  }
  adder.join();
  EXPECT_TRUE(right);
}

TEST(DistributionStress, LookingOnDisturbsNothing) {
  Distribution distribution;
  std::atomic<bool> finished{false};
  std::thread adder([&] {
    for (std::uint64_t value = 1; value <= kRounds / 10; ++value) distribution.add(value);
    finished = true;
  });
  std::uint64_t last_count = 0;
  bool forward = true;
  while (!finished) {
    const std::uint64_t count = distribution.summary().count;
    forward = forward && count >= last_count;
    last_count = count;
  }
  adder.join();
  EXPECT_TRUE(forward);
  EXPECT_EQ(distribution.summary().count, kRounds / 10);
  EXPECT_EQ(distribution.summary().most, kRounds / 10);
}

}  // namespace
}  // namespace armature::rt
