// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/model/model.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"

namespace armature::controllers {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Vector = std::vector<double>;

class ModelTest : public ::testing::Test {
 protected:
  ModelTest() {
    model.set("joints", 2);
    model.set("robot_description", std::string_view(TESTDATA "/pan_tilt.urdf"));
  }
  const Vector& torques(const Vector& motion) {
    model.write("In", motion);
    return model.output<Vector>("Out");
  }

  testing::Harness model{std::make_unique<Model>("Model")};
};

TEST_F(ModelTest, ComputesTheTorquesOfTheDescribedRobot) {
  ASSERT_TRUE(model.start()) << model.reason();
  const double tilt = 0.7;
  const double weight = 1.1 * 9.81 * 0.08 * std::cos(tilt);
  const double tilting = 0.006 + 1.1 * 0.08 * 0.08;
  const Vector at_rest = torques({0.3, tilt, 0.0, 0.0, 0.0, 0.0});
  EXPECT_NEAR(at_rest[0], 0.0, 1e-12);
  EXPECT_NEAR(at_rest[1], weight, 1e-12);
  EXPECT_NEAR(torques({0.3, tilt, 0.0, 0.0, 0.0, 2.0})[1], weight + 2.0 * tilting, 1e-12);
  // Panning turns column and head, whose arm is shorter the more it is tilted.
  const double across = 0.007 + 1.1 * 0.08 * 0.08;
  const double panning =
      0.004 + across * std::pow(std::cos(tilt), 2) + 0.003 * std::pow(std::sin(tilt), 2);
  EXPECT_NEAR(torques({0.3, tilt, 0.0, 0.0, 3.0, 0.0})[0], 3.0 * panning, 1e-12);
}

TEST_F(ModelTest, GravityIsAProperty) {
  model.set("gravity", "[0, 0, 0]");
  ASSERT_TRUE(model.start()) << model.reason();
  EXPECT_THAT(torques({0.3, 0.7, 0.0, 0.0, 0.0, 0.0}), ElementsAre(0.0, 0.0));
}

TEST_F(ModelTest, RefusesAFileThatIsNotThere) {
  model.set("robot_description", std::string_view("nowhere.urdf"));
  EXPECT_FALSE(model.start());
  EXPECT_EQ(model.reason(),
            "nowhere.urdf: error: cannot be read, expected the description of a robot (URDF) (give "
            "the path of a file that exists)");
}

TEST_F(ModelTest, RefusesAnotherNumberOfJointsNamingThem) {
  model.set("joints", 3);
  EXPECT_FALSE(model.start());
  EXPECT_THAT(model.reason(),
              HasSubstr("pan_tilt.urdf moves 2 joints, expected joints = 3: pan, tilt"));
}

TEST_F(ModelTest, RefusesALinkThatIsNotThere) {
  model.set("tip_link", std::string_view("hed"));
  EXPECT_FALSE(model.start());
  EXPECT_THAT(model.reason(), HasSubstr("unknown link 'hed' in robot 'pan_tilt'"));
}

TEST_F(ModelTest, FaultsForAMotionThatIsNoNumber) {
  ASSERT_TRUE(model.start()) << model.reason();
  model.write("In", Vector{0.3, 0.7, 0.0, std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
  EXPECT_EQ(model.state(), component::State::kException);
  EXPECT_EQ(model.reason(), "the torques are not finite: number 4 of In is nan");
  EXPECT_EQ(model.writes("Out"), 0u);
}

TEST_F(ModelTest, StopsIfNothingComes) {
  ASSERT_TRUE(model.start()) << model.reason();
  torques(Vector(6, 0.0));
  model.advance(std::chrono::milliseconds(101));
  EXPECT_EQ(model.state(), component::State::kStopped);
}

}  // namespace
}  // namespace armature::controllers
