// SPDX-License-Identifier: Apache-2.0
#include "armature/component/observing/cycle_record.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"

namespace armature::component {
namespace {

using ::testing::ElementsAre;

class Worker : public Component {
 public:
  using Component::Component;
};

std::vector<std::string> steps_of(const CycleRecord& record) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < record.count(); ++i) {
    const CycleRecord::Step& step = record.step(i);
    all.push_back(step.component->name() + " " + std::to_string(step.begin) + "-" +
                  std::to_string(step.end));
  }
  return all;
}

TEST(CycleRecord, StepsOfOneComponentThatFollowEachOtherAreOne) {
  const Worker a("A");
  const Worker b("B");
  CycleRecord record(8);
  record.open(3, base::time_from_ns(1'000), 100);
  record.add_step(&a, 100, 110);
  record.add_step(&a, 110, 120);
  record.add_step(&b, 120, 130);
  record.add_step(nullptr, 130, 140);
  record.add_step(&b, 140, 150);
  EXPECT_FALSE(record.full());
  record.close(160);
  EXPECT_TRUE(record.full());
  EXPECT_EQ(record.number(), 3u);
  EXPECT_EQ(record.end() - record.begin(), 60u);
  EXPECT_THAT(steps_of(record), ElementsAre("A 100-120", "B 120-130", "B 140-150"));
}

TEST(CycleRecord, CountsStepsWithoutRoomAndIsUsedAgain) {
  const Worker a("A");
  const Worker b("B");
  CycleRecord record(1);
  for (std::uint64_t cycle = 1; cycle <= 2; ++cycle) {
    record.open(cycle, {}, 0);
    record.add_step(&a, 0, 1);
    record.add_step(&b, 1, 2);
    record.add_step(&a, 2, 3);
    record.close(3);
    EXPECT_THAT(steps_of(record), ElementsAre("A 0-1"));
    EXPECT_EQ(record.left_out(), 2u);
    record.empty();
    EXPECT_FALSE(record.full());
  }
}

}  // namespace
}  // namespace armature::component
