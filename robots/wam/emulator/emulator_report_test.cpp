// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/emulator_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::wam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

EmulatorState active_state() {
  EmulatorState state{.motors = 4, .mode = BoardMode::kActive, .zeroed = true};
  state.pendant.activate_lamp = true;
  state.pendant.levels[0] = Level::kWarning;
  state.position = {0.5, -2, 0, 3.125};
  state.torque = {0, 0.25, -0.25, 0};
  state.pucks.fill(PuckState::kReady);
  state.pucks[2] = PuckState::kWaking;
  state.pucks[4] = state.pucks[5] = state.pucks[6] = PuckState::kOff;
  state.frames = 1234;
  return state;
}

TEST(EmulatorReport, AStateIsALineForMachines) {
  EXPECT_EQ(json_line(active_state(), 1.5),
            R"({"time":1.500000,"mode":"active","key":"none","display":"0",)"
            R"("lamps":{"activate":true,"idle":false},)"
            R"("monitors":{"velocity":"warning","torque":"safe","voltage":"safe",)"
            R"("heartbeat":"safe","other":"safe"},"zeroed":true,"carried":false,"diverged":false,)"
            R"("position":[0.5,-2,0,3.125],"torque":[0,0.25,-0.25,0],)"
            R"("pucks":["ready","ready","waking","ready"],"frames":1234,"broken_frames":0})");
}

TEST(EmulatorReport, ATerminalShowsBoardJointsAndMotors) {
  EXPECT_THAT(status_lines(active_state(), 2500.0),
              ElementsAre("active  display 0  lamps A-  velocity warning  zeroed  3 of 4 ready  "
                          "2500 frames/s",
                          "joints [rad]      0.500   -2.000    0.000    3.125",
                          "motors [N m]      0.000    0.250   -0.250    0.000"));
}

TEST(EmulatorReport, PeopleAreToldOfChangesOnly) {
  EmulatorChanges changes;
  EmulatorState state{.motors = 7};
  EXPECT_THAT(changes.take(state, 0.0),
              ElementsAre("     0.000 s  board: E-stop: the pucks have no power"));
  state.position[1] = 0.5;
  state.frames = 7;
  EXPECT_THAT(changes.take(state, 1.0), IsEmpty());
  state.mode = BoardMode::kIdle;
  state.pucks[2] = PuckState::kMonitor;
  state.pendant.levels[2] = Level::kFault;
  state.zeroed = state.carried = state.diverged = true;
  EXPECT_THAT(changes.take(state, 2.0),
              ElementsAre(HasSubstr("2.000 s  board: idle"), HasSubstr("board: voltage fault"),
                          HasSubstr("board: positions are zeroed"), HasSubstr("puck 3: monitor"),
                          HasSubstr("arm: is carried home"), HasSubstr("arm: its simulation")));
  EXPECT_THAT(changes.take(state, 3.0), IsEmpty());
  state.pucks.fill(PuckState::kOff);
  changes.take(state, 4.0);
  state.pucks.fill(PuckState::kBooting);
  EXPECT_THAT(changes.take(state, 5.0), ElementsAre("     5.000 s  all pucks: booting"));
}

}  // namespace
}  // namespace armature::wam
