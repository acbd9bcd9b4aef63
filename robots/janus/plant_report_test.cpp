// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/plant_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::janus {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(PlantReport, AStateIsALineForMachines) {
  const PlantState state{.time = {},
                         .position = {0.5, -0.25},
                         .cards = {AicState::kOn, AicState::kWatchdog},
                         .brake_released = {true, false}};
  EXPECT_EQ(json_line(state, 1.5),
            R"({"time":1.500000,"position":[0.5,-0.25],"state":["on","watchdog"],)"
            R"("brake_released":[true,false]})");
}

TEST(PlantReport, PeopleAreToldOfChangesOnly) {
  ChangeReport report;
  PlantState state;
  EXPECT_THAT(report.take(state, 0.0),
              ElementsAre(HasSubstr("card 1, at  0.000 rad: started"), HasSubstr("card 2")));
  state.position = {0.5, 0.5};
  EXPECT_THAT(report.take(state, 1.0), IsEmpty());
  state.cards[1] = AicState::kWatchdog;
  state.brake_released[0] = true;
  EXPECT_THAT(report.take(state, 2.0),
              ElementsAre(HasSubstr("2.000 s  card 1, at  0.500 rad: brake released"),
                          HasSubstr("card 2, at  0.500 rad: watchdog: the host is silent")));
}

}  // namespace
}  // namespace armature::janus
