// SPDX-License-Identifier: Apache-2.0
#include "armature/can/bus_link.hpp"

#include <gtest/gtest.h>

#include "armature/can/internal/server_rig.hpp"

namespace armature::can {
namespace {

using namespace std::chrono_literals;

class BusLinks : public ::testing::Test {
 protected:
  BusLinks() {
    base::Diagnostics diagnostics;
    EXPECT_TRUE(link.open({}, diagnostics)) << diagnostics.to_text();
  }

  internal::TestFolder folder;
  const std::string path = folder.file("bus");
  internal::ServedBus served{path};
  BusLink link{"virtual:" + path, 1'000'000};
};

TEST_F(BusLinks, TheWaitEndsWhenSomethingCame) {
  served.with([](VirtualBus& bus, BusServer&) {
    VirtualStation& device = bus.add_station("device");
    base::Diagnostics diagnostics;
    ASSERT_TRUE(device.open({}, diagnostics)) << diagnostics.to_text();
    ASSERT_EQ(device.send(data_frame(0x123, {7})), SendStatus::kSent);
  });
  const base::Time deadline = link.now() + 20s;
  Arrival arrival;
  while (link.bus().receive(arrival) != ReceiveStatus::kReceived && link.now() < deadline) {
    link.wait_for_news(deadline);
  }
  EXPECT_EQ(arrival.frame, data_frame(0x123, {7}));
  EXPECT_LT(link.now(), deadline);
}

TEST_F(BusLinks, TheDeadlineEndsTheWaitWhenNothingComes) {
  const base::Time deadline = link.now() + 1ms;
  while (link.now() < deadline) link.wait_for_news(deadline);
  Arrival arrival;
  EXPECT_EQ(link.bus().receive(arrival), ReceiveStatus::kNothing);
}

TEST(BusLink, ABusThatIsNotThereIsNamed) {
  const internal::TestFolder folder;
  BusLink link("virtual:" + folder.file("bus"), 1'000'000);
  base::Diagnostics diagnostics;
  EXPECT_FALSE(link.open({}, diagnostics));
  EXPECT_NE(diagnostics.to_text().find("no process serves there"), std::string::npos);
}

}  // namespace
}  // namespace armature::can
