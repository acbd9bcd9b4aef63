// SPDX-License-Identifier: Apache-2.0
// When a node looks after what: rounds of links, and the clock of its timers.
#include "armature/ride/internal/node/link_rounds.hpp"

#include <chrono>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "armature/ride/internal/node/node_clock.hpp"

namespace armature::ride::internal {
namespace {

using namespace std::chrono_literals;

constexpr base::Time at(base::Duration time) { return base::Time(time); }

class LinkRoundsTest : public testing::Test {
 protected:
  /// Nobody looks at it.
  std::shared_ptr<Link> link() {
    return {std::shared_ptr<void>(), reinterpret_cast<Link*>(&place_)};
  }

  bool done_ = false;
  int looks_ = 0;
  LinkRounds rounds_{10ms, [this](Link&, base::Time) {
                       ++looks_;
                       return done_;
                     }};

 private:
  std::max_align_t place_{};
};

TEST_F(LinkRoundsTest, ALinkIsLookedAfterInEachIntervalUntilItNeedsItNoMore) {
  EXPECT_TRUE(rounds_.is_empty());
  rounds_.add(link(), at(0ms));
  EXPECT_EQ(rounds_.due(), at(10ms));
  rounds_.make_if_due(at(9ms));
  EXPECT_EQ(looks_, 0);
  rounds_.make_if_due(at(11ms));
  EXPECT_EQ(looks_, 1);
  EXPECT_EQ(rounds_.due(), at(21ms));
  done_ = true;
  rounds_.make_if_due(at(21ms));
  EXPECT_TRUE(rounds_.is_empty());
  rounds_.make_if_due(at(1h));
  EXPECT_EQ(looks_, 2);
}

TEST_F(LinkRoundsTest, ALinkThatComesLaterDoesNotPutTheOthersOff) {
  rounds_.add(link(), at(0ms));
  rounds_.add(link(), at(8ms));
  EXPECT_EQ(rounds_.due(), at(10ms));
}

TEST(NodeClock, ItsTimersAreDueAtTheEarliestTimeThatAnyAskedFor) {
  NodeClock clock;
  const base::Time now = clock.look();
  clock.wake_at(now + 1h);
  clock.wake_at(now);
  clock.wake_at(now + 2h);
  EXPECT_EQ(clock.due(), now);
  EXPECT_TRUE(clock.take_due());
  EXPECT_FALSE(clock.take_due()) << "until somebody asks again";
  clock.wake_at(now + 1h);
  EXPECT_FALSE(clock.take_due());
  EXPECT_EQ(clock.due(), now + 1h);
}

}  // namespace
}  // namespace armature::ride::internal
