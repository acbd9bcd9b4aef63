// SPDX-License-Identifier: Apache-2.0
#include "armature/testing/kept_port.hpp"

#include <gtest/gtest.h>

#include "armature/platform/sockets/stream_socket.hpp"

namespace armature::testing {
namespace {

using platform::StreamListener;

TEST(KeptPort, IsListenedAtAgainAndAgainByOneAtATime) {
  const KeptPort port;
  for (int life = 0; life < 2; ++life) {
    const auto listener = StreamListener::listen_tcp("127.0.0.1", port.number());
    ASSERT_TRUE(listener.ok()) << listener.error();
    EXPECT_FALSE(StreamListener::listen_tcp("127.0.0.1", port.number()).ok());
  }
}

}  // namespace
}  // namespace armature::testing
