// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/outbox.hpp"

#include <array>
#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/clock.hpp"
#include "armature/rt/guard.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/rt/lane.hpp"
#include "armature/rt/wakeup.hpp"

namespace armature::rt {
namespace {

TEST(Outbox, AThreadWithoutOneNotifiesAtOnce) {
  Wakeup wakeup;
  notify_soon(wakeup);
  EXPECT_TRUE(wakeup.try_wait());
}

TEST(Outbox, WakesEachOnceWhenItIsFlushed) {
  Outbox outbox;
  const Outbox::Scope sending(outbox);
  Wakeup first;
  Wakeup second;
  for (int i = 0; i < 3; ++i) {
    notify_soon(first);
    notify_soon(second);
  }
  EXPECT_TRUE(outbox.any());
  EXPECT_FALSE(first.try_wait());
  outbox.flush();
  EXPECT_FALSE(outbox.any());
  EXPECT_TRUE(first.try_wait());
  EXPECT_TRUE(second.try_wait());
  outbox.flush();
  EXPECT_FALSE(first.try_wait());
}

TEST(Outbox, WakesAllWhenThereIsNoRoomForAnother) {
  Outbox outbox;
  const Outbox::Scope sending(outbox);
  std::array<Wakeup, Outbox::kMost + 1> wakeups;
  for (Wakeup& each : wakeups) notify_soon(each);
  for (std::size_t i = 0; i < Outbox::kMost; ++i) EXPECT_TRUE(wakeups[i].try_wait()) << i;
  EXPECT_FALSE(wakeups.back().try_wait());
  outbox.flush();
  EXPECT_TRUE(wakeups.back().try_wait());
}

TEST(Outbox, IsFlushedWhenItsScopeEnds) {
  Outbox outbox;
  Wakeup wakeup;
  {
    const Outbox::Scope sending(outbox);
    notify_soon(wakeup);
  }
  EXPECT_TRUE(wakeup.try_wait());
}

TEST(Outbox, IsFlushedBeforeTheThreadSleeps) {
  Outbox outbox;
  const Outbox::Scope sending(outbox);
  Wakeup question;
  Wakeup answer;
  std::thread other([&] {
    question.wait();
    answer.notify();
  });
  notify_soon(question);
  EXPECT_TRUE(answer.wait_until(platform::monotonic_now() + std::chrono::seconds(20)));
  other.join();
}

TEST(Outbox, IsFlushedBeforeTheThreadMayBlock) {
  Outbox outbox;
  const Outbox::Scope sending(outbox);
  Wakeup wakeup;
  notify_soon(wakeup);
  const PermitScope permitted;
  EXPECT_TRUE(wakeup.try_wait());
}

/// Notes what it is sent, with its name.
class Listener final : public Recipient {
 public:
  Listener(std::string name, std::vector<std::string>& heard)
      : name_(std::move(name)), heard_(heard) {}
  std::size_t receive(const std::byte*) override {
    heard_.push_back(name_);
    return 8;
  }

 private:
  std::string name_;
  std::vector<std::string>& heard_;
};

/// A thread that is sent data.
struct Reader {
  Reader(const std::string& name, std::vector<std::string>& heard) : listener(name, heard) {
    for (int i = 0; i < 3; ++i) lane.reserve(8);
    lane.prepare();
  }
  Inbox inbox;
  Wakeup wakeup;
  Lane lane{inbox};
  Listener listener;
};

class OutboxOrder : public ::testing::Test {
 protected:
  void gather(Reader& reader) {
    EXPECT_NE(outbox_.add(reader.lane, reader.wakeup, reader.listener, 8), nullptr);
  }
  std::vector<std::string> heard_;
  Reader one_{"one", heard_};
  Reader two_{"two", heard_};
  Outbox outbox_;
  const Outbox::Scope sending_{outbox_};
};

TEST_F(OutboxOrder, DataIsSentAndItsReaderWokenByAFlush) {
  gather(one_);
  gather(one_);
  EXPECT_TRUE(one_.inbox.empty());
  EXPECT_TRUE(outbox_.any());
  outbox_.flush();
  EXPECT_FALSE(outbox_.any());
  one_.inbox.deliver_all();
  EXPECT_THAT(heard_, ::testing::ElementsAre("one", "one"));
  EXPECT_TRUE(one_.wakeup.try_wait());
}

TEST_F(OutboxOrder, DataForOneIsSentBeforeDataForAnotherIsGathered) {
  gather(one_);
  gather(two_);
  EXPECT_FALSE(one_.inbox.empty());
  EXPECT_FALSE(one_.wakeup.try_wait()) << "who is sent data is woken by the flush";
  EXPECT_TRUE(two_.inbox.empty());
  gather(one_);
  EXPECT_FALSE(two_.inbox.empty());
  outbox_.flush();
  EXPECT_TRUE(one_.wakeup.try_wait());
  EXPECT_TRUE(two_.wakeup.try_wait());
}

TEST_F(OutboxOrder, DataIsSentBeforeTheThreadMayBlock) {
  gather(one_);
  const PermitScope permitted;
  EXPECT_FALSE(one_.inbox.empty());
  EXPECT_TRUE(one_.wakeup.try_wait());
  EXPECT_EQ(Outbox::current(), nullptr);
}

}  // namespace
}  // namespace armature::rt
