// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/sockets/poller.hpp"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "armature/platform/clock.hpp"

namespace armature::platform {
namespace {

using namespace std::chrono_literals;

class PollerTest : public testing::Test {
 protected:
  PollerTest() { EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends_), 0); }
  ~PollerTest() override {
    ::close(ends_[0]);
    ::close(ends_[1]);
  }
  void write() { EXPECT_EQ(::write(ends_[1], "x", 1), 1); }

  int ends_[2] = {-1, -1};
  std::unique_ptr<Poller> poller_ = std::move(Poller::make().value());
};

TEST_F(PollerTest, TellsWhatCanBeReadByItsKey) {
  ASSERT_TRUE(poller_->add(ends_[0], 42, {.read = true}));
  EXPECT_TRUE(poller_->wait(0s).empty());
  write();
  const auto ready = poller_->wait(base::Duration::max());
  ASSERT_EQ(ready.size(), 1u);
  EXPECT_EQ(ready[0].key, 42u);
  EXPECT_TRUE(ready[0].read);
  EXPECT_FALSE(ready[0].write);
}

TEST_F(PollerTest, TellsWhatCanBeWritten) {
  ASSERT_TRUE(poller_->add(ends_[0], 1, {.write = true}));
  const auto ready = poller_->wait(base::Duration::max());
  ASSERT_EQ(ready.size(), 1u);
  EXPECT_TRUE(ready[0].write);
}

TEST_F(PollerTest, TellsNothingOfWhatItHasNoInterestIn) {
  ASSERT_TRUE(poller_->add(ends_[0], 1, {.read = true}));
  write();
  ASSERT_TRUE(poller_->change(ends_[0], 1, {}));
  EXPECT_TRUE(poller_->wait(0s).empty());
  ASSERT_TRUE(poller_->change(ends_[0], 1, {.read = true}));
  EXPECT_EQ(poller_->wait(0s).size(), 1u);
  poller_->remove(ends_[0]);
  EXPECT_TRUE(poller_->wait(0s).empty());
}

TEST_F(PollerTest, TellsNewsOnceAndAnewWhenAsked) {
  const Interest news{.read = true, .news = true};
  ASSERT_TRUE(poller_->add(ends_[0], 1, news));
  write();
  EXPECT_EQ(poller_->wait(0s).size(), 1u);
  EXPECT_TRUE(poller_->wait(0s).empty());
  ASSERT_TRUE(poller_->change(ends_[0], 1, news));
  EXPECT_EQ(poller_->wait(0s).size(), 1u);
  write();
  EXPECT_EQ(poller_->wait(0s).size(), 1u);
}

TEST_F(PollerTest, TellsThatTheOtherSideHasEnded) {
  ASSERT_TRUE(poller_->add(ends_[0], 1, {.read = true, .news = true}));
  write();
  auto ready = poller_->wait(0s);
  ASSERT_EQ(ready.size(), 1u);
  EXPECT_FALSE(ready[0].ended);
  ASSERT_EQ(::shutdown(ends_[1], SHUT_WR), 0);
  ready = poller_->wait(0s);
  ASSERT_EQ(ready.size(), 1u);
  EXPECT_TRUE(ready[0].ended);
  EXPECT_TRUE(ready[0].read);
}

TEST_F(PollerTest, WakesForEachAlarmOnce) {
  poller_->wake();
  poller_->wake();
  EXPECT_TRUE(poller_->wait(base::Duration::max()).empty());
  std::thread other([this] { poller_->wake(); });
  EXPECT_TRUE(poller_->wait(base::Duration::max()).empty());
  other.join();
}

TEST_F(PollerTest, WakesAtTheEarliestTimeThatWasAskedFor) {
  const base::Time soon = monotonic_now() + 2ms;
  poller_->wake_at(soon + 1h);
  poller_->wake_at(soon);
  poller_->wake_at(soon + 2h);
  EXPECT_TRUE(poller_->wait(base::Duration::max()).empty());
  EXPECT_TRUE(poller_->time_has_come());
  EXPECT_GE(monotonic_now(), soon);
}

TEST_F(PollerTest, WakesOnceForATime) {
  poller_->wake_at(base::Time{});
  EXPECT_TRUE(poller_->wait(base::Duration::max()).empty());
  EXPECT_TRUE(poller_->time_has_come());
  ASSERT_TRUE(poller_->add(ends_[0], 1, {.read = true}));
  write();
  EXPECT_EQ(poller_->wait(base::Duration::max()).size(), 1u);
  EXPECT_FALSE(poller_->time_has_come());
}

TEST_F(PollerTest, TakesALaterTimeOnceTheEarlierHasCome) {
  poller_->wake_at(base::Time{});
  EXPECT_TRUE(poller_->wait(base::Duration::max()).empty());
  const base::Time later = monotonic_now() + 1ms;
  poller_->wake_at(later);
  EXPECT_TRUE(poller_->wait(base::Duration::max()).empty());
  EXPECT_GE(monotonic_now(), later);
}

TEST_F(PollerTest, ReturnsWhenTheTimeIsOver) { EXPECT_TRUE(poller_->wait(100us).empty()); }

}  // namespace
}  // namespace armature::platform
