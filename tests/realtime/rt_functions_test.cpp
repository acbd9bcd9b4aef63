// SPDX-License-Identifier: Apache-2.0
// The real-time functions of base, platform, types and rt.
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "armature/base/fixed_text.hpp"
#include "armature/platform/clock.hpp"
#include "armature/platform/futex.hpp"
#include "armature/rt/alarms.hpp"
#include "armature/rt/entry_pool.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/rt/lane.hpp"
#include "armature/rt/latest.hpp"
#include "armature/rt/log.hpp"
#include "armature/rt/outbox.hpp"
#include "armature/rt/passage.hpp"
#include "armature/rt/quick_latest.hpp"
#include "armature/rt/ring.hpp"
#include "armature/rt/statistics.hpp"
#include "armature/rt/try_lock.hpp"
#include "armature/rt/wakeup.hpp"
#include "armature/types/struct.hpp"
#include "armature/types/type.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature {

struct Reading {
  double time = 0.0;
  std::vector<double> positions;
  base::FixedText<15> label;
};

ARMATURE_STRUCT(Reading, time, positions, label);

namespace {

TEST(RealtimeFunctions, FixedText) {
  base::FixedText<15> text;
  bool equal = true;
  expect_realtime("FixedText", [&] {
    text.assign("joint");
    text.append(" 1, and more than there is room for");
    equal = equal && text == base::FixedText<15>("joint 1, and mo");
  });
  EXPECT_TRUE(equal);
}

TEST(RealtimeFunctions, TryLock) {
  rt::TryLock lock;
  int taken = 0;
  expect_realtime("TryLock::try_lock", [&] { taken += lock.try_lock() ? 1 : 0; });
  EXPECT_EQ(taken, 1);
  expect_realtime("TryLock::unlock", [&] { lock.unlock(); });
}

TEST(RealtimeFunctions, Clocks) {
  base::Time last{};
  expect_realtime("platform::monotonic_now", [&] { last = platform::monotonic_now(); });
  EXPECT_GT(last, base::Time{});
  std::uint64_t ticks = 0;
  expect_realtime("platform::ticks", [&] { ticks = platform::ticks(); });
  EXPECT_GT(ticks, 0u);
}

TEST(RealtimeFunctions, EntryPool) {
  struct Entry {
    rt::InUse in_use;
  };
  rt::EntryPool<Entry> pool(1);
  int claimed = 0;
  expect_realtime("EntryPool::claim", [&] {
    if (Entry* const entry = pool.claim()) {
      claimed += pool.claim() == nullptr ? 1 : 2;
      entry->in_use.give_back();
    }
  });
  EXPECT_GT(claimed, 0);
}

TEST(RealtimeFunctions, FutexWake) {
  std::atomic<std::uint32_t> word{0};
  expect_realtime("platform::futex_wake_one", [&] { platform::futex_wake_one(word); });
}

TEST(RealtimeFunctions, TypesOfTheSameShape) {
  const types::Type& type = types::type_of<Reading>();
  const Reading a{1.0, {1.0, 2.0, 3.0}, "a"};
  Reading b{2.0, {4.0, 5.0, 6.0}, "b"};
  bool same = false;
  expect_realtime("types::same_shape", [&] {
    same = types::same_shape(type, &a, &b);
    type.assign(&b, &a);
  });
  EXPECT_TRUE(same);
  EXPECT_EQ(b.positions, a.positions);
}

TEST(RealtimeFunctions, Encoding) {
  const types::Type& type = types::type_of<Reading>();
  const Reading reading{1.0, {1.0, 2.0, 3.0}, "a"};
  std::vector<std::byte> to(types::encoded_size(type, &reading));
  std::size_t size = 0;
  expect_realtime("types::encoded_size", [&] { size = types::encoded_size(type, &reading); });
  EXPECT_EQ(size, to.size());
  expect_realtime("types::encode_to", [&] { size = types::encode_to(type, &reading, to.data()); });
  EXPECT_EQ(size, to.size());
}

TEST(RealtimeFunctions, LatestOfAVector) {
  const std::vector<double> sample(7, 1.0);
  rt::Latest<std::vector<double>> latest(sample);
  bool fresh = false;
  expect_realtime("Latest::write", [&] { latest.write(sample); });
  expect_realtime("Latest::fetch", [&] {
    latest.write(sample);
    fresh = latest.fetch();
  });
  EXPECT_TRUE(fresh);
}

class RingTest : public ::testing::TestWithParam<rt::WhenFull> {};

TEST_P(RingTest, PushAndPopOfAVector) {
  const std::vector<double> sample(7, 1.0);
  rt::Ring<std::vector<double>> ring(8, GetParam(), sample);
  expect_realtime("Ring::push", [&] { ring.push(sample); });  // full before it ends
  const std::vector<double>* last = nullptr;
  expect_realtime("Ring::pop", [&] {
    ring.push(sample);
    last = ring.pop();
  });
  ASSERT_NE(last, nullptr);
  EXPECT_EQ(*last, sample);
}

INSTANTIATE_TEST_SUITE_P(WhenFull, RingTest,
                         ::testing::Values(rt::WhenFull::kDropNewest, rt::WhenFull::kDropOldest));

struct CountedMessage final : rt::Signal {
  CountedMessage() : rt::Signal(&deliver) {}
  static void deliver(rt::Message& message) {
    auto& self = static_cast<CountedMessage&>(message);
    self.lower();
    ++self.delivered;
  }
  int delivered = 0;
};

TEST(RealtimeFunctions, Inbox) {
  rt::Inbox inbox;
  CountedMessage message;
  bool empty = true;
  const auto take = [&] {
    rt::Message* const taken = inbox.take_all();
    if (taken != nullptr) taken->deliver();
  };
  expect_realtime("Inbox::push", [&] {
    inbox.push(message);
    take();
  });
  expect_realtime("Inbox::empty", [&] { empty = empty && inbox.empty(); });
  expect_realtime("Inbox::take_all", take);
  expect_realtime("Signal::raise", [&] {
    message.raise(inbox);
    message.raise(inbox);
    take();
  });
  EXPECT_TRUE(empty);
  EXPECT_EQ(message.delivered, 202);
  CountedMessage other;
  expect_realtime("Inbox::deliver_all", [&] {
    inbox.push(other);
    inbox.push(message);
    inbox.deliver_all();
  });
  EXPECT_TRUE(inbox.empty());
  EXPECT_GT(other.delivered, 0);
}

TEST(RealtimeFunctions, LogQueueFullOrNot) {
  rt::LogQueue queue(8);
  rt::LogRecord record;
  record.format = "{} of {}";
  record.take({rt::LogArgument(1), rt::LogArgument("a text")});
  expect_realtime("LogQueue::push", [&] { queue.push(record); });
  EXPECT_EQ(queue.dropped(), 101u - 8u);
}

TEST(RealtimeFunctions, LogRecordOfNumbersAndOfTextsTooLongForIt) {
  const std::string texts(rt::LogRecord::kTextRoom / 2 + 1, 'x');
  const std::string_view text = texts;
  rt::LogRecord record;
  record.format = "{} {} {} {}";
  expect_realtime("LogRecord::take", [&] { record.take({1, 2.0, text, text}); });
  EXPECT_TRUE(record.message().ends_with("x...")) << record.message();
}

TEST(RealtimeFunctions, Distribution) {
  rt::Distribution distribution;
  std::uint64_t value = 1;
  expect_realtime("Distribution::add", [&] { distribution.add(value *= 3); });
  EXPECT_EQ(distribution.summary().count, 101u);
}

TEST(RealtimeFunctions, WakeupOfAThreadThatSleeps) {
  rt::Wakeup wakeup;
  rt::Wakeup answer;
  std::atomic<bool> ending{false};
  std::thread sleeper([&] {
    while (!ending) {
      wakeup.wait();
      answer.notify();
    }
  });
  expect_realtime("Wakeup::notify", [&] {
    wakeup.notify();
    const rt::PermitScope permit;
    answer.wait();
  });
  ending = true;
  wakeup.notify();
  sleeper.join();
}

TEST(RealtimeFunctions, WakeupThatIsTried) {
  rt::Wakeup wakeup;
  bool taken = true;
  expect_realtime("Wakeup::try_wait", [&] {
    wakeup.notify();
    taken = taken && wakeup.try_wait() && !wakeup.try_wait();
  });
  EXPECT_TRUE(taken);
}

TEST(RealtimeFunctions, AlarmsSetAndRung) {
  rt::Alarms alarms;
  rt::Wakeup sleeper;
  const std::size_t number = alarms.add(sleeper);
  const base::Time due = base::Time(base::Duration(1));
  bool woken = true;
  expect_realtime("Alarms::set", [&] { alarms.set(number, due); });
  expect_realtime("Alarms::ring", [&] {
    alarms.set(number, due);
    woken = woken && alarms.ring(due) == base::Time::max() && sleeper.try_wait();
  });
  EXPECT_TRUE(woken);
}

struct Numbered {
  std::uint64_t sequence = 0;
};

TEST(RealtimeFunctions, QuickLatest) {
  rt::QuickLatest<Numbered> latest(Numbered{});
  std::uint64_t written = 0;
  const Numbered* found = nullptr;
  expect_realtime("QuickLatest::write", [&] { latest.write({++written}); });
  expect_realtime("QuickLatest::fetch", [&] {
    latest.write({++written});
    found = latest.fetch();
  });
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->sequence, written);
}

/// What is sent to it in batches, or by the other way.
class Destination final : public rt::Recipient {
 public:
  std::size_t receive(const std::byte* data) override {
    if (const Numbered* const value = passage.receive(data)) last = value->sequence;
    return sizeof(Numbered);
  }
  rt::Passage<Numbered> passage{Numbered{}};
  std::uint64_t last = 0;
};

TEST(RealtimeFunctions, LaneAndPassage) {
  rt::Inbox inbox;
  rt::Lane lane(inbox);
  Destination destination;
  lane.reserve(sizeof(Numbered));
  lane.prepare();
  std::uint64_t written = 0;
  bool gathered = true;
  expect_realtime("Lane::add", [&] {
    std::byte* const place = lane.add(destination, sizeof(Numbered));
    gathered = gathered && destination.passage.write({++written}, place);
    lane.send();
    inbox.deliver_all();
  });
  expect_realtime("Lane::send", [&] { lane.send(); });
  expect_realtime("Passage::write",
                  [&] { gathered = gathered && !destination.passage.write({++written}, nullptr); });
  EXPECT_TRUE(gathered);
  const Numbered* found = nullptr;
  expect_realtime("Passage::fetch", [&] {
    destination.passage.write({++written}, nullptr);
    found = destination.passage.fetch();
  });
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->sequence, written);
  expect_realtime("Passage::receive", [&] {
    const Numbered value{++written};
    std::byte data[sizeof value];
    std::memcpy(data, &value, sizeof value);
    destination.receive(data);
  });
  EXPECT_EQ(destination.last, written);
}

TEST(RealtimeFunctions, WhatIsPutOff) {
  rt::Wakeup wakeup;  // outlives the scope, whose end may notify it
  rt::Outbox outbox;
  const rt::Outbox::Scope sending(outbox);
  bool woken = true;
  expect_realtime("rt::notify_soon", [&] {
    rt::notify_soon(wakeup);
    woken = woken && !wakeup.try_wait();
  });
  expect_realtime("Outbox::flush", [&] {
    rt::notify_soon(wakeup);
    outbox.flush();
    woken = woken && wakeup.try_wait();
  });
  expect_realtime("rt::flush_outbox", [&] {
    rt::notify_soon(wakeup);
    rt::flush_outbox();
    woken = woken && wakeup.try_wait();
  });
  EXPECT_TRUE(woken);
}

TEST(RealtimeFunctions, WhatIsGathered) {
  rt::Inbox inbox;
  rt::Lane lane(inbox);
  Destination destination;
  lane.reserve(sizeof(Numbered));
  lane.prepare();
  rt::Wakeup wakeup;  // outlives the scope, whose end may notify it
  rt::Outbox outbox;
  const rt::Outbox::Scope sending(outbox);
  std::uint64_t written = 0;
  const auto gather = [&] {
    std::byte* const place = outbox.add(lane, wakeup, destination, sizeof(Numbered));
    destination.passage.write({++written}, place);
  };
  expect_realtime("Outbox::add", [&] {
    gather();
    outbox.flush();
    inbox.deliver_all();
  });
  expect_realtime("Outbox::send_gathered", [&] {
    gather();
    outbox.send_gathered();
    inbox.deliver_all();
  });
  expect_realtime("rt::send_gathered", [&] {
    gather();
    rt::send_gathered();
    inbox.deliver_all();
  });
  EXPECT_EQ(destination.last, written);
}

}  // namespace
}  // namespace armature
