// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/watch_union.hpp"

#include <chrono>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::studio::internal {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kInterval = 0.016;

/// A run that answers when it is told to; vectors of it have two elements.
class TestRun final : public WatchedRun {
 public:
  void watch(const std::vector<std::string>& items, double interval,
             Told<remote::Watch> told) override {
    asked.push_back(items);
    intervals.push_back(interval);
    answers_.emplace_back([this, items, told = std::move(told)] {
      for (const std::string& item : items) {
        if (item == refused || items.size() > most) {
          return told(base::Error{"'" + item + "' has no numbers"});
        }
      }
      remote::Watch watch{++handles_, {}};
      for (const std::string& item : items) {
        if (!item.ends_with(".vector")) watch.items.push_back({item, "rad"});
        for (const char* element : {"[1]", "[2]"}) {
          if (item.ends_with(".vector")) watch.items.push_back({item + element, "rad"});
        }
      }
      given = watch.items;
      told(watch);
    });
  }
  void watched(std::int32_t handle, Told<remote::WatchedValues> told) override {
    ++questions;
    answers_.emplace_back([this, handle, count = given.size(), told = std::move(told)] {
      if (handle == lost) return told(base::Error{"unknown watch"});
      remote::WatchedValues values;
      for (std::size_t i = 0; i < count; ++i) values.values.push_back(first + double(i));
      values.ages.assign(count, std::isnan(first) ? first : 0.004);
      told(values);
    });
  }
  void end_watch(std::int32_t handle) override { ended.push_back(handle); }

  /// Whatever it owes, and what comes of that.
  void answer(WatchUnion& pages) {
    while (!answers_.empty()) {
      const auto now = std::exchange(answers_, {});
      for (const auto& one : now) one();
      pages.advance(*this);
    }
  }

  std::vector<std::vector<std::string>> asked;
  std::vector<double> intervals;
  std::vector<remote::WatchedItem> given;
  std::vector<std::int32_t> ended;
  std::string refused;
  std::size_t most = 100;
  std::int32_t lost = 0;
  int questions = 0;
  double first = 10.0;

 private:
  std::vector<std::function<void()>> answers_;
  std::int32_t handles_ = 0;
};

class Watched : public ::testing::Test {
 protected:
  /// @return why it is refused, or the handle as text
  std::string watch(const std::vector<std::string>& items, double interval = kInterval) {
    std::string answer;
    pages_->watch(run_, items, interval, {}, [&](const auto& watch) {
      answer = watch ? std::to_string(watch.value().handle) : watch.error();
    });
    run_.answer(*pages_);
    return answer;
  }
  /// A new one's values; each is asked before the run answers.
  std::vector<std::vector<double>> values(const std::vector<std::string>& handles) {
    std::vector<std::vector<double>> all(handles.size());
    for (std::size_t i = 0; i < handles.size(); ++i) {
      pages_->watched(run_, std::stoi(handles[i]), [&all, this, i](const auto& sample) {
        if (sample) all[i] = sample.value().values;
        if (!sample) refusal_ = sample.error();
      });
    }
    run_.answer(*pages_);
    return all;
  }
  void pass(base::Duration time) {
    now_ += time;
    pages_->end_lost();
    pages_->advance(run_);
    run_.answer(*pages_);
  }

  TestRun run_;
  base::Time now_{};
  std::string refusal_;
  std::shared_ptr<WatchUnion> pages_ = std::make_shared<WatchUnion>([] {}, [this] { return now_; });
};

TEST_F(Watched, EachPageHasItsOwnNumbersOfOneWatch) {
  const std::string a = watch({"A.x", "B.vector"});
  const std::string b = watch({"C.y", "B.vector[2]", "A.x"}, 0.1);
  EXPECT_THAT(run_.asked, ElementsAre(ElementsAre("A.x", "B.vector"),
                                      ElementsAre("A.x", "B.vector", "C.y", "B.vector[2]")));
  EXPECT_THAT(run_.intervals, ElementsAre(kInterval, kInterval)) << "the shortest counts";
  EXPECT_THAT(run_.ended, ElementsAre(1)) << "one watch follows the other";
  EXPECT_THAT(values({a, b}), ElementsAre(ElementsAre(10, 11, 12), ElementsAre(13, 12, 10)));
  EXPECT_EQ(run_.questions, 1) << "one sample serves both";
}

TEST_F(Watched, PagesThatLookAtTheSameAskTheRunForNothingMore) {
  const std::vector<std::string> items = {"A.x", "B.vector"};
  std::vector<std::string> handles;
  for (int i = 0; i < 4; ++i) handles.push_back(watch(items));
  EXPECT_EQ(run_.asked.size(), 1u);
  for (int turn = 0; turn < 60; ++turn) {
    now_ += 16ms;
    for (const auto& each : values(handles)) EXPECT_THAT(each, ElementsAre(10, 11, 12));
  }
  EXPECT_EQ(run_.questions, 60);
}

TEST_F(Watched, ASampleIsNoOlderThanMostOfTheInterval) {
  const std::string a = watch({"A.x"});
  const std::string b = watch({"A.x"});
  EXPECT_THAT(values({a}), ElementsAre(ElementsAre(10)));
  run_.first = 20.0;
  now_ += 11ms;
  EXPECT_THAT(values({b}), ElementsAre(ElementsAre(10)));
  now_ += 2ms;
  EXPECT_THAT(values({b}), ElementsAre(ElementsAre(20)));
}

TEST_F(Watched, ARefusedItemIsThatOfItsPageAlone) {
  const std::string a = watch({"A.x"});
  run_.refused = "A.name";
  EXPECT_THAT(watch({"A.name"}), HasSubstr("'A.name' has no numbers"));
  EXPECT_THAT(values({a}), ElementsAre(ElementsAre(10)));
  EXPECT_THAT(run_.ended, IsEmpty());
}

TEST_F(Watched, WhatTheRunDoesNotTakeTogetherIsWatchedSideBySide) {
  run_.most = 2;
  const std::string a = watch({"A.x", "A.y"});
  const std::string b = watch({"B.x"});
  ASSERT_EQ(run_.asked.size(), 3u);
  EXPECT_THAT(run_.asked.back(), ElementsAre("B.x"));
  EXPECT_THAT(values({b}), ElementsAre(ElementsAre(10)));
  EXPECT_TRUE(pages_->end(std::stoi(b)));
  pages_->advance(run_);
  EXPECT_THAT(run_.ended, ElementsAre(2));
}

TEST_F(Watched, WhatNobodyLooksAtAnyMoreIsWatchedNoLonger) {
  const std::string a = watch({"A.x"});
  const std::string b = watch({"B.x"});
  EXPECT_TRUE(pages_->end(std::stoi(b)));
  EXPECT_FALSE(pages_->end(std::stoi(b)));
  pass(500ms);
  EXPECT_EQ(run_.asked.size(), 2u) << "it may begin another one at once";
  pass(600ms);
  ASSERT_EQ(run_.asked.size(), 3u);
  EXPECT_THAT(run_.asked.back(), ElementsAre("A.x"));
  EXPECT_THAT(values({a}), ElementsAre(ElementsAre(10)));
  pass(5s);
  EXPECT_EQ(run_.asked.size(), 3u);
  EXPECT_TRUE(pages_->end(std::stoi(a)));
  pages_->advance(run_);
  EXPECT_THAT(run_.ended, ElementsAre(1, 2, 3));
}

TEST_F(Watched, NumbersStayUntilTheThreadsHaveHadACycle) {
  const std::string a = watch({"A.x"});
  EXPECT_THAT(values({a}), ElementsAre(ElementsAre(10)));
  watch({"B.x"});
  run_.first = NAN;
  now_ += 20ms;
  EXPECT_THAT(values({a}), ElementsAre(ElementsAre(10)));
  now_ += 3s;
  EXPECT_TRUE(std::isnan(values({a}).at(0).at(0))) << "it has gone since";
}

TEST_F(Watched, AWatchThatTheRunHasEndedIsBegunAnewByItsPage) {
  const std::string a = watch({"A.x"});
  run_.lost = 1;
  values({a});
  EXPECT_EQ(refusal_, "unknown watch");
  values({a});
  EXPECT_THAT(refusal_, HasSubstr("it has ended, or never began"));
  EXPECT_THAT(values({watch({"A.x"})}), ElementsAre(ElementsAre(10)));
}

TEST_F(Watched, APageHasABoundedNumber) {
  for (std::size_t i = 0; i < WatchUnion::kMostOfOne; ++i) watch({"A.x"});
  EXPECT_THAT(watch({"A.x"}), HasSubstr("too many watches"));
}

TEST(Places, AreThoseOfTheItemAndItsParts) {
  const std::vector<remote::WatchedItem> given = {{"S.v[1]", ""}, {"S.v[2]", ""}, {"S.v[2]", ""},
                                                  {"S.vw", ""},   {"S.p.x", ""},  {"S.p.y", ""}};
  EXPECT_THAT(places_of({"S.v"}, given), ElementsAre(0, 1));
  EXPECT_THAT(places_of({"S.v[2]"}, given), ElementsAre(1));
  EXPECT_THAT(places_of({"S.p", "S.vw"}, given), ElementsAre(4, 5, 3));
  EXPECT_THAT(places_of({"S.none"}, given), IsEmpty());
}

}  // namespace
}  // namespace armature::studio::internal
