// SPDX-License-Identifier: Apache-2.0
// How a program that begins later finds our node. Apart from the other tests: Fast DDS numbers the
// participants of a process, and the node asks the first ones of a machine only.
#include <string>

#include <gtest/gtest.h>

#include "bridges/ros2/participant.hpp"
#include "fast_peer.hpp"
#include "ros_messages_descriptors.hpp"

namespace armature::ros2 {
namespace {

constexpr int kDomain = 66;

/// Milliseconds that are waited until a peer that begins now has found our reader.
int waits_until_found(Asks asks) {
  FastPeer peer(kDomain, asks);
  auto* const writer = peer.write_to<std_msgs::msg::dds_::String_PubSubType>("rt/found");
  int waits = 0;
  EXPECT_TRUE(wait_until([&] {
    ++waits;
    return is_matched(*writer);
  }));
  return waits;
}

TEST(Discovery, WhoAsksByMulticastFindsTheNodeWithinItsNextAnnouncement) {
  const auto ours = Participant::open({.node = "tested", .domain = kDomain});
  ASSERT_TRUE(ours) << ours.error();
  const auto reader = ours.value()->read_from("found", string_type(), {});
  ASSERT_TRUE(reader) << reader.error();
  // Behind the first one the next announcement is as far away as it can be.
  for (int k = 0; k < 2; ++k) EXPECT_LT(waits_until_found(Asks::kByMulticast), 4000);
}

}  // namespace
}  // namespace armature::ros2
