// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/address.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::ride {
namespace {

using ::testing::HasSubstr;

TEST(Address, IsReadAsItIsWritten) {
  for (const char* text : {"tcp://127.0.0.1:4242", "tcp://[::1]:1", "unix:/run/robot.sock",
                           "tls://robot.example:65535", "tcp://localhost:0"}) {
    const auto address = Address::parse(text);
    ASSERT_TRUE(address.ok()) << address.error();
    EXPECT_EQ(address.value().text(), text);
  }
  EXPECT_EQ(Address::parse("tcp://[::1]:7").value(), (Address{"tcp", "::1", 7}));
}

TEST(Address, ErrorsSayWhatWasExpected) {
  const auto error = [](const char* text) { return Address::parse(text).error(); };
  EXPECT_THAT(error("127.0.0.1"), HasSubstr("has no transport"));
  EXPECT_THAT(error("tcp:127.0.0.1:1"), HasSubstr("has no // behind the transport"));
  EXPECT_THAT(error("tcp://127.0.0.1"), HasSubstr("has no port"));
  EXPECT_THAT(error("tcp://127.0.0.1:x"), HasSubstr("port is not a number from 0 to 65535"));
  EXPECT_THAT(error("tcp://127.0.0.1:65536"), HasSubstr("port is not a number"));
  EXPECT_THAT(error("tcp://:1"), HasSubstr("has no host"));
  EXPECT_THAT(error("unix:"), HasSubstr("has no path; expected an address such as"));
}

}  // namespace
}  // namespace armature::ride
