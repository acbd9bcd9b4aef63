// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/sockets/can_socket.hpp"

#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <net/if.h>

#include "armature/platform/internal/can_state.hpp"

namespace armature::platform {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

// True with and without CAN in the kernel: no interface has this name.
TEST(CanSocket, OpeningFailsWithTheInterfaceTheReasonAndAWayOut) {
  base::Diagnostics diagnostics;
  CanSocketRequest request;
  request.interface = "can_none";
  EXPECT_EQ(CanSocket::open(request, diagnostics), nullptr);
  ASSERT_EQ(diagnostics.error_count(), 1u);
  const std::string text = diagnostics.to_text();
  EXPECT_THAT(text, HasSubstr("CAN interface 'can_none': "));
  EXPECT_THAT(text, AnyOf(HasSubstr("the kernel gives no CAN socket: "),
                          HasSubstr("this interface does not exist: ")));
  EXPECT_THAT(text, AnyOf(HasSubstr("'modprobe can-raw'"), HasSubstr("'ip link'")));
}

TEST(CanState, IsNothingForWhatIsNoController) {
  EXPECT_EQ(internal::can_state(::if_nametoindex("lo")), std::nullopt);
  EXPECT_EQ(internal::can_state(99'999), std::nullopt) << "no interface at all";
}

}  // namespace
}  // namespace armature::platform
