// SPDX-License-Identifier: Apache-2.0
#include "armature/control/dynamics/inverse_dynamics.hpp"

#include <cmath>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::control {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pointwise;

constexpr double kGravity = 9.81;

std::string link(const std::string& name, double mass, const std::string& centre,
                 const std::string& moments) {
  return "<link name='" + name + "'><inertial><origin xyz='" + centre + "'/><mass value='" +
         std::to_string(mass) + "'/><inertia " + moments + "/></inertial></link>";
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& axis,
                  const std::string& origin = "xyz='0 0 0'") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/><axis xyz='" + axis + "'/><origin " + origin +
         "/><limit lower='-3' upper='3' effort='1' velocity='1'/></joint>";
}

std::string robot(const std::string& content) {
  return "<robot name='test'><link name='base'/>" + content + "</robot>";
}

const char kRound[] = "ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='0' iyz='0'";

/// Hangs down at 0 and turns about y.
std::string pendulum() {
  return robot(link("rod", 2.0, "0 0 -0.5", kRound) +
               joint("swing", "continuous", "base", "rod", "0 1 0"));
}

/// Two links of 0.6 m and 0.4 m in the plane x z, which turn about -y: positive is up.
std::string two_link_arm() {
  return robot(link("upper", 3.0, "0.3 0 0", kRound) + link("lower", 2.0, "0.2 0 0", kRound) +
               joint("shoulder", "revolute", "base", "upper", "0 -1 0") +
               joint("elbow", "revolute", "upper", "lower", "0 -1 0", "xyz='0.6 0 0'"));
}

/// Three joints with skew axes, turned origins, a slide and a fixed body at its end.
std::string skew_arm() {
  const char odd[] = "ixx='0.02' iyy='0.03' izz='0.025' ixy='0.002' ixz='-0.001' iyz='0.003'";
  return robot(link("a", 1.5, "0.1 0.02 -0.03", odd) + link("b", 1.0, "0 0.1 0.05", odd) +
               link("c", 0.7, "0.03 0 0.1", odd) + link("tool", 0.4, "0 0.05 0", odd) +
               joint("j1", "revolute", "base", "a", "0 0.6 0.8", "xyz='0 0 0.3' rpy='0.2 0 0.1'") +
               joint("j2", "prismatic", "a", "b", "1 0 0", "xyz='0.2 0 0' rpy='0 0.4 0'") +
               joint("j3", "revolute", "b", "c", "0 0.8 -0.6", "xyz='0 0.2 0' rpy='1 0 0.5'") +
               joint("mount", "fixed", "c", "tool", "1 0 0", "xyz='0 0 0.1' rpy='0 0.3 0'"));
}

InverseDynamics make(const std::string& urdf, const InverseDynamics::Config& config = {}) {
  base::Diagnostics diagnostics;
  auto made = InverseDynamics::parse(urdf, "test.urdf", config, diagnostics);
  EXPECT_TRUE(made.has_value()) << diagnostics.to_text();
  EXPECT_TRUE(diagnostics.empty()) << diagnostics.to_text();
  return std::move(made.value());
}

std::string mistakes_in(const std::string& urdf, const InverseDynamics::Config& config = {}) {
  base::Diagnostics diagnostics;
  const auto made = InverseDynamics::parse(urdf, "test.urdf", config, diagnostics);
  EXPECT_EQ(made.has_value(), diagnostics.ok());
  return diagnostics.to_text();
}

std::vector<double> torques(InverseDynamics& model, const std::vector<double>& q,
                            const std::vector<double>& qd, const std::vector<double>& qdd) {
  std::vector<double> motion = q;
  motion.insert(motion.end(), qd.begin(), qd.end());
  motion.insert(motion.end(), qdd.begin(), qdd.end());
  std::vector<double> result(q.size());
  EXPECT_TRUE(model.step(motion, result));
  return result;
}

/// Random motions, the same in every run.
class Motions {
 public:
  std::vector<double> next(std::size_t joints) {
    std::vector<double> numbers(joints);
    for (double& number : numbers) number = uniform_(engine_);
    return numbers;
  }

 private:
  std::mt19937 engine_{7};
  std::uniform_real_distribution<double> uniform_{-1.5, 1.5};
};

std::vector<double> unit(std::size_t size, std::size_t index) {
  std::vector<double> vector(size, 0.0);
  vector[index] = 1.0;
  return vector;
}

TEST(InverseDynamics, OfAPendulumIsThatOfTheTextbook) {
  auto model = make(pendulum());
  EXPECT_THAT(model.joint_names(), ElementsAre("swing"));
  const double inertia = 0.01 + 2.0 * 0.5 * 0.5;
  for (const double q : {0.0, 0.3, 1.2, -2.0}) {
    const double expected = inertia * 0.7 + 2.0 * kGravity * 0.5 * std::sin(q);
    EXPECT_NEAR(torques(model, {q}, {1.3}, {0.7})[0], expected, 1e-12);
  }
}

TEST(InverseDynamics, OfATwoLinkArmIsThatOfTheTextbook) {
  auto model = make(two_link_arm());
  const double l1 = 0.6, c1 = 0.3, c2 = 0.2, m1 = 3.0, m2 = 2.0, i1 = 0.01, i2 = 0.01;
  Motions motions;
  for (int i = 0; i < 20; ++i) {
    const auto q = motions.next(2), qd = motions.next(2), qdd = motions.next(2);
    const double cos2 = std::cos(q[1]), h = m2 * l1 * c2 * std::sin(q[1]);
    const double d11 = i1 + i2 + m1 * c1 * c1 + m2 * (l1 * l1 + c2 * c2 + 2.0 * l1 * c2 * cos2);
    const double d12 = i2 + m2 * (c2 * c2 + l1 * c2 * cos2);
    const double d22 = i2 + m2 * c2 * c2;
    const double g2 = m2 * kGravity * c2 * std::cos(q[0] + q[1]);
    const double g1 = (m1 * c1 + m2 * l1) * kGravity * std::cos(q[0]) + g2;
    const double first =
        d11 * qdd[0] + d12 * qdd[1] - h * (2.0 * qd[0] * qd[1] + qd[1] * qd[1]) + g1;
    const double second = d12 * qdd[0] + d22 * qdd[1] + h * qd[0] * qd[0] + g2;
    EXPECT_THAT(torques(model, q, qd, qdd),
                Pointwise(DoubleNear(1e-12), std::vector<double>{first, second}));
  }
}

TEST(InverseDynamics, TheInertiaMatrixIsSymmetricAndPositive) {
  auto model = make(skew_arm(), {.gravity = {0.0, 0.0, 0.0}});
  Motions motions;
  const std::vector<double> rest(3, 0.0);
  for (int trial = 0; trial < 10; ++trial) {
    const auto q = motions.next(3), direction = motions.next(3);
    std::vector<std::vector<double>> columns;
    for (std::size_t j = 0; j < 3; ++j) columns.push_back(torques(model, q, rest, unit(3, j)));
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < i; ++j) EXPECT_NEAR(columns[i][j], columns[j][i], 1e-12);
    }
    const auto push = torques(model, q, rest, direction);
    double product = 0.0;
    for (std::size_t i = 0; i < 3; ++i) product += push[i] * direction[i];
    EXPECT_GT(product, 0.0);
  }
}

/// qd' D(q) qd / 2, by the torques that a unit of acceleration needs.
double kinetic_energy(InverseDynamics& weightless, const std::vector<double>& q,
                      const std::vector<double>& qd) {
  const auto momentum = torques(weightless, q, std::vector<double>(q.size(), 0.0), qd);
  double energy = 0.0;
  for (std::size_t i = 0; i < q.size(); ++i) energy += 0.5 * momentum[i] * qd[i];
  return energy;
}

TEST(InverseDynamics, TheMassMatrixAndGravityAreTheirPartsOfTheTorques) {
  auto model = make(skew_arm());
  Motions motions;
  const std::vector<double> rest(3, 0.0);
  for (int trial = 0; trial < 10; ++trial) {
    const auto q = motions.next(3), qdd = motions.next(3);
    std::vector<double> expected(3), matrix(9);
    ASSERT_TRUE(model.gravity(q, expected));
    EXPECT_THAT(torques(model, q, rest, rest), Pointwise(DoubleNear(1e-12), expected));
    ASSERT_TRUE(model.mass_matrix(q, matrix));
    for (std::size_t i = 0; i < 9; ++i) expected[i / 3] += matrix[i] * qdd[i % 3];
    EXPECT_THAT(torques(model, q, rest, qdd), Pointwise(DoubleNear(1e-12), expected));
  }
}

TEST(InverseDynamics, ThePowerOfTheJointsIsTheChangeOfEnergy) {
  auto model = make(skew_arm(), {.gravity = {0.0, 0.0, 0.0}});
  Motions motions;
  constexpr double kStep = 1e-5;
  for (int trial = 0; trial < 10; ++trial) {
    const auto q = motions.next(3), qd = motions.next(3), qdd = motions.next(3);
    const auto at = [&](double time) {
      std::vector<double> position = q, velocity = qd;
      for (std::size_t i = 0; i < 3; ++i) {
        position[i] += qd[i] * time + 0.5 * qdd[i] * time * time;
        velocity[i] += qdd[i] * time;
      }
      return kinetic_energy(model, position, velocity);
    };
    const auto torque = torques(model, q, qd, qdd);
    double power = 0.0;
    for (std::size_t i = 0; i < 3; ++i) power += torque[i] * qd[i];
    EXPECT_NEAR(power, (at(kStep) - at(-kStep)) / (2.0 * kStep), 1e-7);
  }
}

TEST(InverseDynamics, GravityPullsAlongItsVectorInTheAxesOfTheBase) {
  auto sideways = make(pendulum(), {.gravity = {kGravity, 0.0, 0.0}});
  // At 0 the rod hangs across this gravity, and turning by -90 deg about y lays it along.
  EXPECT_NEAR(torques(sideways, {0.0}, {0.0}, {0.0})[0], 2.0 * kGravity * 0.5, 1e-12);
  EXPECT_NEAR(torques(sideways, {-M_PI_2}, {0.0}, {0.0})[0], 0.0, 1e-12);
}

TEST(InverseDynamics, WhatIsFixedToALinkMovesWithIt) {
  const std::string rod = link("rod", 2.0, "0 0 -0.5", kRound);
  const std::string swing = joint("swing", "revolute", "base", "rod", "0 1 0");
  auto model =
      make(robot(rod + swing + link("weight", 3.0, "0 0 0", kRound) +
                 joint("weld", "fixed", "rod", "weight", "1 0 0", "xyz='0 0 -1' rpy='0.5 0 0'")));
  const double moment = 2.0 * 0.5 + 3.0 * 1.0;
  EXPECT_NEAR(torques(model, {0.4}, {0.0}, {0.0})[0], moment * kGravity * std::sin(0.4), 1e-12);
  EXPECT_NEAR(torques(model, {0.0}, {0.0}, {1.0})[0], 0.02 + 2.0 * 0.25 + 3.0, 1e-12);
}

TEST(InverseDynamics, AJointThatSlidesHasAForce) {
  auto model = make(robot(link("car", 2.0, "0 0 0", kRound) +
                          joint("lift", "prismatic", "base", "car", "0 0 1")));
  EXPECT_NEAR(torques(model, {0.3}, {0.1}, {1.5})[0], 2.0 * (1.5 + kGravity), 1e-12);
}

TEST(InverseDynamics, ABranchingRobotNeedsATip) {
  const std::string urdf =
      robot(link("left", 1.0, "0 0 -0.5", kRound) + link("right", 2.0, "0 0 -0.5", kRound) +
            joint("l", "revolute", "base", "left", "0 1 0") +
            joint("r", "revolute", "base", "right", "0 1 0"));
  EXPECT_EQ(mistakes_in(urdf),
            "test.urdf: error: the robot branches: joints 'l', 'r' branch from one link, expected "
            "a chain (name the end of the chain with tip_link)\n");
  base::Diagnostics diagnostics;
  auto model = InverseDynamics::parse(urdf, "test.urdf", {.tip_link = "right"}, diagnostics);
  ASSERT_TRUE(model);
  EXPECT_THAT(model->joint_names(), ElementsAre("r"));
  EXPECT_EQ(diagnostics.to_text(),
            "test.urdf: warning: joint 'l' is not on the way to 'right': it counts as fixed at "
            "0\n");
}

TEST(InverseDynamics, TheChainMayBeginAboveTheRoot) {
  auto model = make(two_link_arm(), {.base_link = "upper"});
  EXPECT_THAT(model.joint_names(), ElementsAre("elbow"));
  EXPECT_NEAR(torques(model, {0.0}, {0.0}, {0.0})[0], 2.0 * kGravity * 0.2, 1e-12);
}

TEST(InverseDynamics, ALinkThatDoesNotExistIsNamedWithTheNearest) {
  EXPECT_THAT(mistakes_in(two_link_arm(), {.tip_link = "lowr"}),
              HasSubstr("test.urdf: error: unknown link 'lowr' in robot 'test' (did you mean "
                        "'lower'?)"));
  EXPECT_THAT(mistakes_in(two_link_arm(), {.base_link = "lower", .tip_link = "upper"}),
              HasSubstr("link 'upper' does not hang on link 'lower'"));
}

TEST(InverseDynamics, JointsThatItCannotComputeAreNamed) {
  EXPECT_THAT(mistakes_in(robot(link("a", 1.0, "0 0 0", kRound) +
                                joint("free", "floating", "base", "a", "0 1 0"))),
              HasSubstr("error: joint 'free' is floating or planar (expected revolute, continuous, "
                        "prismatic or fixed)"));
  EXPECT_THAT(mistakes_in("<robot name='r'><link name='a'/></robot>"),
              HasSubstr("no joint moves between 'a' and the end of the robot"));
}

TEST(InverseDynamics, AnAxisWithoutADirectionIsNamed) {
  EXPECT_THAT(mistakes_in(robot(link("a", 1.0, "0 0 0", kRound) +
                                joint("j", "revolute", "base", "a", "0 0 0"))),
              HasSubstr("error: joint 'j' has the axis 0 0 0 (expected a direction)"));
}

TEST(InverseDynamics, ALinkThatHangsOnTwoJointsIsNamed) {
  EXPECT_THAT(mistakes_in(robot(link("a", 1.0, "0 0 0", kRound) + link("b", 1.0, "0 0 0", kRound) +
                                joint("j", "revolute", "base", "a", "0 0 1") +
                                joint("k", "fixed", "a", "b", "0 0 1") +
                                joint("l", "fixed", "a", "b", "0 0 1"))),
              HasSubstr("error: link 'b' is the child of two joints (expected a tree)"));
}

TEST(InverseDynamics, AJointThatFollowsAnotherIsNamed) {
  std::string urdf = robot(link("a", 1.0, "0 0 0", kRound) + link("b", 1.0, "0 0 0", kRound) +
                           joint("j", "revolute", "base", "a", "0 0 1") +
                           joint("k", "revolute", "a", "b", "0 0 1"));
  urdf.insert(urdf.rfind("</joint>"), "<mimic joint='j'/>");
  EXPECT_THAT(mistakes_in(urdf), HasSubstr("error: joint 'k' mimics joint 'j' (expected joints "
                                           "that move independently)"));
}

TEST(InverseDynamics, BodiesThatCannotBeAreNamed) {
  const std::string swing = joint("swing", "revolute", "base", "rod", "0 1 0");
  EXPECT_THAT(mistakes_in(robot(link("rod", -2.0, "0 0 0", kRound) + swing)),
              HasSubstr("error: the inertial element of link 'rod' is physically impossible"));
  EXPECT_THAT(
      mistakes_in(robot(
          link("rod", 2.0, "0 0 0", "ixx='1' iyy='1' izz='1' ixy='2' ixz='0' iyz='0'") + swing)),
      HasSubstr("expected a mass of at least 0 and a positive semidefinite inertia"));
}

TEST(InverseDynamics, AJointThatMovesNoMassIsAWarning) {
  EXPECT_EQ(
      mistakes_in(robot("<link name='rod'/>" + joint("swing", "revolute", "base", "rod", "0 1 0"))),
      "test.urdf: warning: nothing that moves with joint 'swing' has a mass (give link "
      "'rod' an inertial element)\n");
}

TEST(InverseDynamics, WhatIsNoUrdfIsRefusedNamingTheFile) {
  const char expected[] = "test.urdf: error: expected the description of a robot (URDF), found: ";
  EXPECT_THAT(mistakes_in("<robot name='r'><link name='a'></robot>"), HasSubstr(expected));
  EXPECT_THAT(mistakes_in("<model/>"), HasSubstr(expected));
  EXPECT_THAT(mistakes_in(""), HasSubstr(expected));
  EXPECT_THAT(mistakes_in(robot(link("a", 1.0, "0 zero 0", kRound) +
                                joint("j", "revolute", "base", "a", "0 1 0"))),
              HasSubstr(expected));
}

TEST(InverseDynamics, AFileThatCannotBeReadIsNamed) {
  base::Diagnostics diagnostics;
  EXPECT_FALSE(InverseDynamics::load("/nowhere/arm.urdf", {}, diagnostics));
  EXPECT_EQ(diagnostics.to_text(),
            "/nowhere/arm.urdf: error: cannot be read, expected the description of a robot (URDF) "
            "(give the path of a file that exists)\n");
}

TEST(InverseDynamics, VectorsOfAnotherSizeAreRefused) {
  auto model = make(two_link_arm());
  std::vector<double> torque(2, 7.0);
  EXPECT_FALSE(model.step(std::vector<double>(5), torque));
  EXPECT_EQ(torque[0], 7.0);
  std::vector<double> short_one(1);
  EXPECT_FALSE(model.step(std::vector<double>(6), short_one));
  EXPECT_TRUE(model.step(std::vector<double>(6), torque));
  EXPECT_FALSE(model.gravity(std::vector<double>(3), torque));
  EXPECT_FALSE(model.mass_matrix(std::vector<double>(2), torque));
}

}  // namespace
}  // namespace armature::control
