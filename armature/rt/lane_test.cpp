// SPDX-License-Identifier: Apache-2.0
#include "armature/rt/lane.hpp"

#include <cstring>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::rt {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class Listener final : public Recipient {
 public:
  Listener(int name, std::vector<int>& heard) : name_(name), heard_(heard) {}
  std::size_t receive(const std::byte* data) override {
    std::int64_t value = 0;
    std::memcpy(&value, data, sizeof value);
    heard_.push_back(100 * name_ + static_cast<int>(value));
    return sizeof value;
  }

 private:
  int name_;
  std::vector<int>& heard_;
};

class LaneTest : public ::testing::Test {
 protected:
  LaneTest() {
    for (int i = 0; i < 2; ++i) lane_.reserve(sizeof(std::int64_t));
    lane_.prepare();
  }
  bool add(Listener& to, std::int64_t value) {
    std::byte* const place = lane_.add(to, sizeof value);
    if (place != nullptr) std::memcpy(place, &value, sizeof value);
    return place != nullptr;
  }

  Inbox inbox_;
  Lane lane_{inbox_};
  std::vector<int> heard_;
  Listener one_{1, heard_};
  Listener two_{2, heard_};
};

TEST_F(LaneTest, WhatIsAddedComesInItsOrderOnceItIsSent) {
  EXPECT_TRUE(add(two_, 1));
  EXPECT_TRUE(add(one_, 2));
  inbox_.deliver_all();
  EXPECT_THAT(heard_, IsEmpty());
  lane_.send();
  inbox_.deliver_all();
  EXPECT_THAT(heard_, ElementsAre(201, 102));
  lane_.send();
  inbox_.deliver_all();
  EXPECT_EQ(heard_.size(), 2u);
}

TEST_F(LaneTest, AFullBatchIsSentByItself) {
  for (int i = 1; i <= 3; ++i) EXPECT_TRUE(add(one_, i));
  inbox_.deliver_all();
  EXPECT_THAT(heard_, ElementsAre(101, 102));
}

TEST_F(LaneTest, NothingCanBeAddedWhileAllBatchesAreUnderWay) {
  int added = 0;
  while (added < 100 && add(one_, added)) {
    ++added;
    lane_.send();
  }
  EXPECT_EQ(added, static_cast<int>(Lane::kBatches));
  inbox_.deliver_all();
  EXPECT_TRUE(add(one_, added));
  lane_.send();
  inbox_.deliver_all();
  EXPECT_THAT(heard_, ElementsAre(100, 101, 102));
}

TEST_F(LaneTest, NothingCanBeAddedBeforeItIsPrepared) {
  Lane unprepared(inbox_);
  unprepared.reserve(8);
  EXPECT_EQ(unprepared.add(one_, 8), nullptr);
  unprepared.send();
  EXPECT_TRUE(inbox_.empty());
}

}  // namespace
}  // namespace armature::rt
