// SPDX-License-Identifier: Apache-2.0
#include "armature/component/black_box.hpp"

#include <array>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/face.hpp"
#include "armature/testing/test_thread.hpp"
#include "armature/types/struct.hpp"

namespace armature::component {

struct Legs {
  double height = 0.0;
  std::vector<float> forces;
  std::array<std::vector<int>, 2> steps;
};
ARMATURE_STRUCT(Legs, height, forces, steps);

namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

class Walker final : public Component {
 public:
  using Component::Component;
  OutputPort<Legs> legs{this, "Legs", "a struct with vectors"};
  OutputPort<bool> up{this, "Up", "a small one"};
  Event<> stumbled{this, "Stumbled", "rare", {}};
};

Legs legs(double height) {
  const auto f = static_cast<float>(height);
  const int i = static_cast<int>(height);
  return {height, {f, f + 1}, {std::vector<int>{i}, std::vector<int>{i, i, i}}};
}

base::Time at(std::int64_t ms) { return base::Time(std::chrono::milliseconds(ms)); }

class BlackBoxes : public testing::Test {
 protected:
  BlackBoxes() : thread_(walker_) {
    walker_.legs.set_sample(legs(0.0));
    face(walker_.legs).prepare();
    thread_.context.black_box = &box_;
  }
  void reserve(std::size_t pictures, std::size_t notes) {
    box_.add(walker_);
    box_.reserve(pictures, notes, std::chrono::milliseconds(10));
  }
  void picture(std::int64_t ms) {
    if (box_.due(at(ms))) box_.make_picture(at(ms));
  }
  /// What all pictures have for the channel, with their times.
  std::vector<std::string> all(std::size_t channel) const {
    const auto content = box_.copy();
    std::vector<std::string> texts;
    for (std::size_t i = 0; content && i < content->times.size(); ++i) {
      const auto value = BlackBox::value_in(content->pictures.data() + i * box_.picture_size(),
                                            box_.channels()[channel]);
      texts.push_back(std::to_string(content->times[i].time_since_epoch().count() / 1'000'000) +
                      " " + std::string(value.text()));
    }
    return texts;
  }

  Walker walker_{"walker"};
  BlackBox box_;
  TestThread thread_;
};

TEST_F(BlackBoxes, APictureHasEveryPortAsItStandsAndHowOftenEventsWereRaised) {
  reserve(4, 4);
  walker_.legs.write(legs(1.0));
  picture(10);
  walker_.legs.write(legs(2.0));
  walker_.up.write(true);
  walker_.stumbled.raise();
  picture(20);
  EXPECT_THAT(all(0), ElementsAre("10 {height: 1, forces: [1, 2], steps: [[1], [1, 1, 1]]}",
                                  "20 {height: 2, forces: [2, 3], steps: [[2], [2, 2, 2]]}"));
  EXPECT_THAT(all(1), ElementsAre("10 false", "20 true"));
  EXPECT_THAT(all(2), ElementsAre("10 0", "20 1"));
}

TEST_F(BlackBoxes, AValueOfMoreThanSixteenKibibytesIsLeftOut) {
  Legs many = legs(0.0);
  many.forces.resize(4 * 1024);
  walker_.legs.set_sample(many);
  face(walker_.legs).prepare();
  reserve(4, 4);
  walker_.up.write(true);
  picture(10);
  EXPECT_THAT(box_.channels(), SizeIs(2));  // Up and Stumbled
  EXPECT_THAT(all(0), ElementsAre("10 true"));
  EXPECT_LT(box_.picture_size(), 64u);
}

TEST_F(BlackBoxes, TheNewestStayAndNoneIsMadeBeforeItIsDue) {
  reserve(2, 4);
  for (const int ms : {10, 12, 20, 25, 29, 40}) picture(ms);
  EXPECT_THAT(all(1), ElementsAre("29 false", "40 false"));
}

TEST_F(BlackBoxes, OfOneInstantTheLastPictureStays) {
  reserve(4, 4);
  picture(10);
  walker_.up.write(true);
  picture(10);
  EXPECT_THAT(all(1), ElementsAre("10 true"));
}

TEST_F(BlackBoxes, AFaultHasItsPictureEvenIfNoneIsDue) {
  reserve(4, 4);
  picture(10);
  picture(11);
  note(walker_, BlackBox::Note::Kind::kFault, {}, "broken");
  picture(12);
  EXPECT_THAT(all(1), ElementsAre("10 false", "12 false"));
}

TEST_F(BlackBoxes, NotesAreKeptInOrderTheNewestOfThem) {
  reserve(2, 3);
  for (const char* text : {"one", "two", "three", "four"}) {
    note(walker_, BlackBox::Note::Kind::kError, "item", text);
  }
  const auto content = box_.copy();
  ASSERT_TRUE(content.has_value());
  std::vector<std::string> texts;
  for (const auto& each : content->notes) texts.emplace_back(each.text.view());
  EXPECT_THAT(texts, ElementsAre("two", "three", "four"));
  EXPECT_EQ(content->notes[0].component, &walker_);
  EXPECT_EQ(content->notes[0].item, "item");
}

TEST_F(BlackBoxes, WithoutRoomNothingIsKeptAndNothingHappens) {
  reserve(0, 0);
  picture(10);
  note(walker_, BlackBox::Note::Kind::kFault, {}, "broken");
  picture(10);
  const auto content = box_.copy();
  ASSERT_TRUE(content.has_value());
  EXPECT_TRUE(content->times.empty());
  EXPECT_TRUE(content->notes.empty());
}

}  // namespace
}  // namespace armature::component
