// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/inbox.hpp"

#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace armature::rt {
namespace {

struct Letter final : Signal {
  Letter() : BasicSignal(count) {}
  static void count(Message& message) {
    auto& self = static_cast<Letter&>(message);
    self.lower();
    ++self.deliveries;
  }
  int deliveries = 0;
};

std::vector<Message*> take(Inbox& inbox) {
  std::vector<Message*> taken;
  for (Message* message = inbox.take_all(); message != nullptr; message = Inbox::next(*message)) {
    taken.push_back(message);
  }
  return taken;
}

TEST(Inbox, GivesMessagesInTheOrderOfTheirPushes) {
  Inbox inbox;
  std::array<Letter, 3> letters;
  for (Letter& letter : letters) inbox.push(letter);
  EXPECT_FALSE(inbox.empty());
  EXPECT_EQ(take(inbox), (std::vector<Message*>{&letters[0], &letters[1], &letters[2]}));
  EXPECT_TRUE(inbox.empty());
  EXPECT_EQ(inbox.take_all(), nullptr);
}

TEST(Inbox, TakesADeliveredMessageAgain) {
  Inbox inbox;
  Letter letter;
  for (int i = 0; i < 3; ++i) {
    inbox.push(letter);
    EXPECT_EQ(take(inbox), std::vector<Message*>{&letter});
  }
}

/// Is sent once more by its own delivery.
struct Echo final : Message {
  explicit Echo(Inbox& its_inbox) : Message(&deliver), inbox(its_inbox) {}
  static void deliver(Message& message) {
    auto& self = static_cast<Echo&>(message);
    ++self.deliveries;
    self.inbox.push(self);
  }
  Inbox& inbox;
  int deliveries = 0;
};

TEST(Inbox, DeliversWhatIsThereAndLeavesWhatComesMeanwhile) {
  Inbox inbox;
  Echo first(inbox);
  Echo second(inbox);
  inbox.push(first);
  inbox.push(second);
  inbox.deliver_all();
  EXPECT_EQ(first.deliveries, 1);
  EXPECT_EQ(second.deliveries, 1);
  EXPECT_EQ(take(inbox), (std::vector<Message*>{&first, &second}));
}

TEST(Signal, IsInTheInboxOnceHoweverOftenItIsRaised) {
  Inbox inbox;
  Letter letter;
  EXPECT_TRUE(letter.raise(inbox));
  EXPECT_FALSE(letter.raise(inbox));
  EXPECT_EQ(take(inbox), std::vector<Message*>{&letter});
}

TEST(Signal, CanBeRaisedAgainFromItsDeliveryOn) {
  Inbox inbox;
  Letter letter;
  letter.raise(inbox);
  Message* const taken = inbox.take_all();
  EXPECT_FALSE(letter.raise(inbox));
  taken->deliver();
  EXPECT_EQ(letter.deliveries, 1);
  EXPECT_TRUE(letter.raise(inbox));
  EXPECT_FALSE(inbox.empty());
}

}  // namespace
}  // namespace armature::rt
