// SPDX-License-Identifier: Apache-2.0
#include "armature/can/socket_can.hpp"

#include <cstdint>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::can {
namespace {

using testing::HasSubstr;

Frame error_frame(std::uint32_t classes, std::uint8_t problem = 0) {
  Frame frame;
  frame.kind = FrameKind::kError;
  frame.id = classes;
  frame.size = 8;
  frame.data[1] = problem;
  return frame;
}

// True with and without CAN in the kernel: no interface has this name.
TEST(SocketCan, OpeningFailsWithTheInterfaceTheReasonAndAWayOut) {
  SocketCan bus("can_none");
  base::Diagnostics diagnostics;
  EXPECT_FALSE(bus.open({}, diagnostics));
  ASSERT_EQ(diagnostics.error_count(), 1u);
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("CAN interface 'can_none': "));
  EXPECT_FALSE(diagnostics.all()[0].hint.empty());
  EXPECT_EQ(bus.state(), BusState::kClosed);
  EXPECT_EQ(bus.send(data_frame(1, {})), SendStatus::kDown);
  Arrival arrival;
  EXPECT_EQ(bus.receive(arrival), ReceiveStatus::kDown);
  EXPECT_EQ(bus.counters().refused, 1u);
}

TEST(SocketCan, ErrorFramesTellTheState) {
  using enum BusState;
  EXPECT_EQ(state_after(kActive, error_frame(error_class::kBusOff)), kBusOff);
  EXPECT_EQ(state_after(kBusOff, error_frame(error_class::kRestarted)), kActive);
  EXPECT_EQ(state_after(kPassive, error_frame(error_class::kProtocol)), kPassive);
  for (const std::uint8_t passive :
       {controller_problem::kReceivePassive, controller_problem::kSendPassive}) {
    EXPECT_EQ(state_after(kActive, error_frame(error_class::kController, passive)), kPassive);
  }
  for (const std::uint8_t active :
       {controller_problem::kActiveAgain, controller_problem::kReceiveWarning,
        controller_problem::kSendWarning}) {
    EXPECT_EQ(state_after(kPassive, error_frame(error_class::kController, active)), kActive);
  }
  EXPECT_EQ(state_after(kActive, error_frame(error_class::kController,
                                             controller_problem::kReceiveOverflow)),
            kActive);
}

}  // namespace
}  // namespace armature::can
