// SPDX-License-Identifier: Apache-2.0
#include "armature/guard/internal/places.hpp"

#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace armature::guard {
namespace {

Sighting sighting(const char* component, std::uintptr_t frame) {
  Sighting made;
  made.call = "malloc";
  made.component = component;
  made.frames[0] = reinterpret_cast<void*>(frame);
  made.frame_count = 1;
  return made;
}

std::size_t known(const Places& places) {
  std::size_t count = 0;
  for (const Place& place : places.all()) count += place.complete ? 1 : 0;
  return count;
}

class PlacesTest : public ::testing::Test {
 protected:
  const std::unique_ptr<Places> places_ = std::make_unique<Places>();
};

TEST_F(PlacesTest, ASecondSightingIsCountedAtItsPlace) {
  EXPECT_TRUE(places_->add(sighting("pid", 1)));
  EXPECT_FALSE(places_->add(sighting("pid", 1)));
  EXPECT_EQ(places_->violations(), 2u);
  EXPECT_EQ(known(*places_), 1u);
}

TEST_F(PlacesTest, AnotherComponentOrStackIsAnotherPlace) {
  places_->add(sighting("pid", 1));
  EXPECT_TRUE(places_->add(sighting("other", 1)));
  EXPECT_TRUE(places_->add(sighting("pid", 2)));
  EXPECT_EQ(known(*places_), 3u);
}

TEST_F(PlacesTest, WithoutRoomViolationsAreStillCounted) {
  for (std::uintptr_t i = 0; i < Places::kCapacity + 5; ++i) places_->add(sighting("pid", i + 1));
  EXPECT_EQ(known(*places_), Places::kCapacity);
  EXPECT_EQ(places_->elsewhere(), 5u);
  EXPECT_EQ(places_->violations(), Places::kCapacity + 5);
}

TEST_F(PlacesTest, ClearingForgetsAll) {
  places_->add(sighting("pid", 1));
  places_->clear();
  EXPECT_EQ(places_->violations(), 0u);
  EXPECT_EQ(known(*places_), 0u);
  EXPECT_TRUE(places_->add(sighting("pid", 1)));
}

TEST_F(PlacesTest, ThreadsAddAtTheSameTime) {
  constexpr std::uintptr_t kPlaces = 50;
  constexpr int kRounds = 200;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([this] {
      for (int round = 0; round < kRounds; ++round) {
        for (std::uintptr_t i = 0; i < kPlaces; ++i) places_->add(sighting("pid", i + 1));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(places_->violations(), 4u * kRounds * kPlaces);
  EXPECT_EQ(known(*places_), kPlaces);
  for (const Place& place : places_->all()) {
    EXPECT_EQ(place.count, place.complete ? 4u * kRounds : 0u);
  }
}

}  // namespace
}  // namespace armature::guard
