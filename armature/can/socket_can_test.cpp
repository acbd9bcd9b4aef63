// SPDX-License-Identifier: Apache-2.0
#include "armature/can/socket_can.hpp"

#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "armature/can/internal/conformance.hpp"
#include "armature/platform/clock.hpp"

namespace armature::can::internal {
namespace {

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
  EXPECT_EQ(state_after(kPassive,
                        error_frame(error_class::kController, controller_problem::kActiveAgain)),
            kActive);
  EXPECT_EQ(state_after(kActive, error_frame(error_class::kController,
                                             controller_problem::kReceiveOverflow)),
            kActive);
}

/// Two sockets on the interface that ARMATURE_CAN_INTERFACE names, such as vcan0.
class SocketRig final : public BusRig {
 public:
  explicit SocketRig(const char* interface) : first_(interface), second_(interface) {}
  Bus& first() override { return first_; }
  Bus& second() override { return second_; }
  // On a virtual interface a frame has come in when it was sent; what is announced comes a little
  // later, from another thread.
  void settle() override { platform::sleep_until(platform::monotonic_now() + kPatience); }

 private:
  static constexpr base::Duration kPatience = std::chrono::milliseconds(20);
  SocketCan first_;
  SocketCan second_;
};

std::vector<BusImplementation> implementations() {
  const char* const interface = std::getenv("ARMATURE_CAN_INTERFACE");
  if (interface == nullptr) return {};
  return {{"socket", [interface] { return std::make_unique<SocketRig>(interface); }}};
}

// Nowhere without such an interface.
INSTANTIATE_TEST_SUITE_P(SocketCan, BusConformance, testing::ValuesIn(implementations()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace armature::can::internal
