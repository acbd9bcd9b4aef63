// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/memory_share.hpp"

#include <memory>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "armature/ride/codec.hpp"

namespace armature::ride {
namespace {

constexpr std::size_t kMiB = 1 << 20;

class MemoryShareTest : public testing::Test {
 protected:
  std::shared_ptr<MemoryShare> share(std::size_t reserve) {
    auto made = std::make_shared<MemoryShare>(all_, reserve);
    EXPECT_TRUE(made->open(false));
    return made;
  }

  std::shared_ptr<MemoryBound> all_ = std::make_shared<MemoryBound>(64 * kMiB, 16 * kMiB);
};

TEST_F(MemoryShareTest, ItsReserveIsItsOwnWhateverOthersTake) {
  const auto own = share(kMiB);
  const auto greedy = share(kMiB);
  while (greedy->take(kMiB)) {
  }
  EXPECT_TRUE(own->take(kMiB));
  EXPECT_LE(all_->used(), 64 * kMiB);
}

TEST_F(MemoryShareTest, WhoeverIsGreedyLeavesSomeForTheNext) {
  const auto first = share(kMiB);
  const auto second = share(kMiB);
  while (first->take(kMiB / 16)) {
  }
  EXPECT_TRUE(second->take(5 * kMiB));
}

TEST_F(MemoryShareTest, SixtyFourGreedyOnesEachHaveTheirReserve) {
  std::vector<std::shared_ptr<MemoryShare>> all;
  for (int k = 0; k < 64; ++k) {
    all.push_back(share(kMiB / 4));
    while (all.back()->take(kMiB / 64)) {
    }
  }
  EXPECT_LE(all_->used(), 64 * kMiB);
  EXPECT_GT(all_->used(), 60 * kMiB);
}

TEST_F(MemoryShareTest, WhatIsGivenBackOrGoesIsThereForOthers) {
  {
    const auto one = share(kMiB);
    EXPECT_EQ(all_->used(), kMiB) << "its reserve";
    ASSERT_TRUE(one->take(20 * kMiB));
    EXPECT_EQ(all_->used(), 20 * kMiB);
    one->give(15 * kMiB);
    EXPECT_EQ(all_->used(), 5 * kMiB);
    one->give(5 * kMiB);
    EXPECT_EQ(all_->used(), kMiB) << "its reserve";
    ASSERT_TRUE(one->take(20 * kMiB));
  }
  EXPECT_EQ(all_->used(), 0u);
}

TEST_F(MemoryShareTest, AReserveThatThereIsNoRoomForIsRefused) {
  std::vector<std::shared_ptr<MemoryShare>> all;
  for (int k = 0; k < 4; ++k) all.push_back(share(4 * kMiB));
  MemoryShare late(all_, kMiB);
  EXPECT_FALSE(late.open(false));
  EXPECT_TRUE(late.open(true));
}

TEST_F(MemoryShareTest, TheReserveOfOneThatHasEndedIsForOthers) {
  const auto gone = share(16 * kMiB);
  ASSERT_TRUE(gone->take(2 * kMiB));
  EXPECT_FALSE(MemoryShare(all_, kMiB).open(false));
  gone->end();
  EXPECT_TRUE(MemoryShare(all_, kMiB).open(false));
  EXPECT_EQ(all_->used(), 2 * kMiB) << "what it still has";
  gone->give(2 * kMiB);
  EXPECT_EQ(all_->used(), 0u);
}

TEST_F(MemoryShareTest, ABodyTakesOfItAndGivesAllBack) {
  const auto own = share(0);
  {
    Body body(own.get());
    body.extend(10 * kMiB);
    EXPECT_GE(all_->used(), 10 * kMiB);
    EXPECT_THROW(body.extend(60 * kMiB), std::bad_alloc);
    EXPECT_EQ(body.size(), 10 * kMiB);
    body.truncate(100);
    body.shrink(1000);
    EXPECT_LE(all_->used(), 1000u);
    Body other = std::move(body);
    EXPECT_EQ(other.size(), 100u);
  }
  EXPECT_EQ(all_->used(), 0u);
}

TEST_F(MemoryShareTest, ABodyKeepsItsBytesHoweverItGrowsAndShrinks) {
  Body body;
  std::size_t written = 0;
  const auto put = [&](std::size_t count) {
    std::byte* const to = body.extend(count);
    for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<std::byte>(written++ % 251);
  };
  const auto is_whole = [&] {
    for (std::size_t i = 0; i < body.size(); ++i) {
      if (body.data()[i] != static_cast<std::byte>(i % 251)) return false;
    }
    return true;
  };
  for (const std::size_t count : {10u, 1000u, 100'000u, 300'000u, 2'000'000u, 1u}) {
    put(count);
    ASSERT_TRUE(is_whole()) << body.size();
  }
  for (const std::size_t size : {300'000u, 200'000u, 50'000u, 10u}) {
    body.truncate(size);
    body.shrink(0);
    ASSERT_TRUE(is_whole()) << size;
    EXPECT_LE(body.capacity(), 2 * size + 64 * 1024);
  }
}

/// An `Array<String>` of empty ones is eight times as large as its body.
TEST_F(MemoryShareTest, ValuesThatGrowAreCountedAndRefusedBeforeTheyAreThere) {
  const auto own = share(0);
  Body body;
  Encoder to(body);
  constexpr std::uint32_t kCount = 3 * kMiB;
  to.put(kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) to.put(0u);
  {
    Holding holding(own);
    Decoder from(body.bytes(), &holding);
    std::vector<std::string> texts;
    EXPECT_THROW(from.take(texts), std::bad_alloc);
  }
  EXPECT_EQ(all_->used(), 0u) << "given back with the holding";
}

TEST_F(MemoryShareTest, AHoldingThatIsMovedKeepsWhatItHas) {
  const auto own = share(0);
  Holding later;
  {
    Holding holding(own);
    holding.take(100);
    EXPECT_EQ(all_->used(), 0u) << "a few small values are not counted";
    holding.take(kMiB);
    later = std::move(holding);
  }
  EXPECT_EQ(all_->used(), kMiB + 100);
  later = Holding();
  EXPECT_EQ(all_->used(), 0u);
}

TEST(Scrap, CountsUntilItIsGivenBackPieceByPieceAndNobodyIsRefusedForIt) {
  constexpr std::size_t kMost = 16 << 20;
  const auto all = std::make_shared<MemoryBound>(kMost, 1 << 20);
  all->set_keeper(std::this_thread::get_id());
  MemoryShare share(all, 256 << 10);
  ASSERT_TRUE(share.open(false));
  const std::size_t before = all->used();
  {
    Body large(&share);
    large.extend(10 << 20);
  }
  EXPECT_TRUE(all->has_scrap());
  const std::size_t let_go_of = all->used();
  EXPECT_GT(let_go_of, before + (9 << 20)) << "nothing is the system's yet";
  EXPECT_TRUE(all->release_scrap());
  EXPECT_LT(all->used(), let_go_of);
  EXPECT_GT(all->used(), let_go_of - (1 << 20)) << "a piece";
  Body another(&share);
  another.extend(10 << 20);
  EXPECT_LE(all->used(), kMost) << "there was room for it, since scrap made some";
  while (all->release_scrap()) {
  }
  EXPECT_FALSE(all->has_scrap());
  another = Body();
  while (all->release_scrap()) {
  }
  EXPECT_EQ(all->used(), before);
}

TEST(Scrap, IsNoneOfAReserveNorOfOtherThreads) {
  const auto all = std::make_shared<MemoryBound>(16 << 20, 8 << 20);
  all->set_keeper(std::this_thread::get_id());
  MemoryShare share(all, 4 << 20);
  ASSERT_TRUE(share.open(false));
  Body(&share).extend(2 << 20);
  EXPECT_FALSE(all->has_scrap()) << "who has a reserve may take it again at once";
  all->set_keeper({});
  MemoryShare other(all, 0);
  Body(&other).extend(2 << 20);
  EXPECT_FALSE(all->has_scrap());
}

}  // namespace
}  // namespace armature::ride
