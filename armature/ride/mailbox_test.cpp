// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/mailbox.hpp"

#include <functional>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::ride::internal {
namespace {

using ::testing::ElementsAre;

class MailboxTest : public testing::Test {
 protected:
  void hand_over(std::uint32_t name) {
    ASSERT_TRUE(mailbox_.hand_over(link(), Message{.header = {.identifier = name}, .body = {}}));
  }
  std::vector<std::uint32_t> taken() {
    std::vector<std::uint32_t> names;
    mailbox_.take_messages(
        [&](Link&, const Message& message) { names.push_back(message.header.identifier); });
    return names;
  }

  Mailbox mailbox_;

 private:
  /// Nobody looks at it.
  Link& link() { return *reinterpret_cast<Link*>(&place_); }
  std::max_align_t place_{};
};

TEST_F(MailboxTest, KeepsMessagesInTheirOrder) {
  EXPECT_TRUE(mailbox_.empty());
  hand_over(1);
  hand_over(2);
  EXPECT_FALSE(mailbox_.empty());
  EXPECT_THAT(taken(), ElementsAre(1, 2));
  EXPECT_TRUE(mailbox_.empty());
}

TEST_F(MailboxTest, AMessageThatComesWhileItIsOpenedIsSeenInTheNextRound) {
  hand_over(1);
  EXPECT_THAT(taken(), ElementsAre(1));
  hand_over(2);
  EXPECT_TRUE(mailbox_.open().tasks.empty());
  EXPECT_FALSE(mailbox_.empty());
  EXPECT_THAT(taken(), ElementsAre(2));
}

TEST_F(MailboxTest, OnceItIsClosedATaskIsTheCallersStill) {
  std::vector<int> done;
  std::function<void()> first = [&] { done.push_back(1); };
  std::function<void()> second = [&] { done.push_back(2); };
  EXPECT_TRUE(mailbox_.post(first));
  for (const auto& task : mailbox_.close()) task();
  EXPECT_FALSE(mailbox_.post(second));
  second();
  EXPECT_THAT(done, ElementsAre(1, 2));
}

}  // namespace
}  // namespace armature::ride::internal
