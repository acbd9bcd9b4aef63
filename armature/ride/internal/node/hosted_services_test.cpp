// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/node/hosted_services.hpp"

#include <gtest/gtest.h>

#include "armature/ride/internal/test_vision.hpp"

namespace armature::ride::internal {
namespace {

class Idle : public VisionService {};

class HostedServicesTest : public testing::Test {
 protected:
  base::Result<std::uint32_t> add(const char* name, Service& service) {
    return services_.add("node", name, service);
  }

  Idle left_;
  Idle right_;
  HostedServices services_;
};

TEST_F(HostedServicesTest, AreFoundByIdentifierAndName) {
  EXPECT_EQ(add("left", left_).value(), 1u);
  EXPECT_EQ(add("right", right_).value(), 2u);
  EXPECT_EQ(services_.find(2)->service, &right_);
  EXPECT_EQ(services_.find("left")->identifier, 1u);
  EXPECT_EQ(services_.find(0), nullptr);
  EXPECT_EQ(services_.find(3), nullptr);
  EXPECT_EQ(services_.find("middle"), nullptr);
  ASSERT_EQ(services_.entries().size(), 2u);
  EXPECT_EQ(services_.entries()[1].name, "right");
  EXPECT_EQ(services_.entries()[1].interface, "Vision");
}

TEST_F(HostedServicesTest, HaveNamesOfTheirOwnAndAreThereOnce) {
  ASSERT_TRUE(add("left", left_).ok());
  EXPECT_EQ(add("left", right_).error(),
            "node 'node' already hosts 'left': give 'left' another name, or remove the first");
  EXPECT_EQ(add("again", left_).error(),
            "node 'node' already hosts 'left': give 'again' another name, or remove the first");
}

TEST_F(HostedServicesTest, AnIdentifierIsNeverGivenAgain) {
  ASSERT_TRUE(add("left", left_).ok());
  EXPECT_EQ(services_.remove(left_), 1u);
  EXPECT_EQ(services_.remove(left_), 0u);
  EXPECT_EQ(services_.find(1), nullptr);
  EXPECT_TRUE(services_.entries().empty());
  EXPECT_EQ(add("left", left_).value(), 2u);
}

}  // namespace
}  // namespace armature::ride::internal
