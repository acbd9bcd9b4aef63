// SPDX-License-Identifier: Apache-2.0
// What a node can be reached by, and where it may listen.
#include "armature/ride/internal/node/transports.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::ride::internal {
namespace {

using testing::HasSubstr;

class TransportsTest : public testing::Test {
 protected:
  std::string objection(const std::string& address) {
    const auto place = Transports(options_).place_to_listen(address);
    return place ? std::string() : place.error();
  }

  NodeOptions options_;
};

TEST_F(TransportsTest, TcpAndUnixSocketsAreAlwaysThere) {
  const Transports transports(options_);
  EXPECT_NE(transports.find("tcp"), nullptr);
  EXPECT_NE(transports.find("unix"), nullptr);
  EXPECT_EQ(transports.find("tls"), nullptr);
  EXPECT_EQ(transports.place_of("tls://robot:1").error(),
            "'tls://robot:1': node 'node' has no transport 'tls'");
}

TEST_F(TransportsTest, ANodeListensWhereOnlyThisMachineReachesIt) {
  EXPECT_EQ(objection("tcp://127.0.0.1:0"), "");
  EXPECT_EQ(objection("unix:/tmp/robot.sock"), "");
}

TEST_F(TransportsTest, ANodeDoesNotListenWhereNobodyProvesWhoHeIs) {
  EXPECT_THAT(objection("tcp://0.0.0.0:0"), HasSubstr("without proving who they are"));
  options_.allows = [](const AccessQuestion&) { return true; };
  EXPECT_THAT(objection("tcp://0.0.0.0:0"), HasSubstr("without proving who they are"));
}

}  // namespace
}  // namespace armature::ride::internal
