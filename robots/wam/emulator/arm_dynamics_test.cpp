// SPDX-License-Identifier: Apache-2.0
// The arms by control's dynamics, beside the golden values of the facts and MuJoCo's own dynamics.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include "armature/control/dynamics/forward_kinematics.hpp"
#include "robots/wam/test_arms.hpp"

namespace armature::wam {
namespace {

struct Golden {
  Vector q;
  std::array<double, 3> tool;  ///< [m]
  Vector gravity;              ///< [N m]
};

// wam7.yaml and wam4.yaml of the facts, which print so many digits.
constexpr double kDigits = 1e-9;
constexpr double kDigitsOfTorque = 1e-6;

const std::vector<Golden>& golden_of(const ArmNumbers& arm) {
  static const std::vector<Golden> wam4{
      {{0, 0, 0, 0}, {0, 0, 0.91}, {0, -0.143416, 0, 0.355595}},
      {{0, -2, 0, 3.13}, {-0.212451496, 0, 0.006333703}, {0, 10.290898, -0.000197, -1.17569}},
      {{0, -1.57, 0, 1.57}, {-0.594963991, 0, 0.405437965}, {0, 12.737199, -0.000217, 0.355595}},
      {{0, 1.5707963267949, 0, 0}, {0.91, 0, 0}, {0, -13.849708, 0.000217, -1.467702}},
      {{0.3, -0.7, 0.4, 1.2},
       {-0.241380837, 0.07380032, 0.768634456},
       {0, 7.313894, -0.458759, -0.435491}}};
  static const std::vector<Golden> wam7{
      {{0, 0, 0, 0, 0, 0, 0}, {0, 0, 0.9109}, {0, -0.147018, 0, 1.211835, 0, 0.000128, 0}},
      {{0, -2, 0, 3.13, 0, 0, 0},
       {-0.211637525, 0, 0.006717697},
       {0, 17.326456, 0.054936, -4.053922, -0.056434, -0.126237, 0.000049}},
      {{0, -1.57, 0, 1.57, 0, 0, 0},
       {-0.594963991, 0, 0.406337965},
       {0, 24.10193, 0.060415, 1.211835, 0, 0.000128, 0}},
      {{0, 1.5707963267949, 0, 0, 0, 0, 0},
       {0.9109, 0, 0},
       {0, -27.945255, -0.060415, -5.05407, -0.062399, -0.139639, 0.000054}},
      {{0.3, -0.7, 0.4, 1.2, -0.5, 0.6, 0.2},
       {-0.211683419, 0.067850437, 0.74966291},
       {0, 12.643087, -1.379202, -1.530652, -0.055964, -0.101878, 0.00001}}};
  return arm.joints() == 4 ? wam4 : wam7;
}

/// At the last of the golden positions, row by row.
const Vector& golden_mass_matrix(const ArmNumbers& arm) {
  static const Vector wam4{0.345073333,  -0.046685268, -0.037380315, -0.023906659,  //
                           -0.046685268, 0.752798485,  -0.048183438, 0.087775732,   //
                           -0.037380315, -0.048183438, 0.047083607,  0.000002816,   //
                           -0.023906659, 0.087775732,  0.000002816,  0.041188773};
  static const Vector wam7{0.512465262,  -0.139695381, -0.125034378, -0.074190686,
                           -0.001160927, 0.000459017,  0.000036593,  //
                           -0.139695381, 1.676004244,  -0.144663047, 0.284149386,
                           0.004213192,  0.003378153,  0.000007604,  //
                           -0.125034378, -0.144663047, 0.139217619,  0.001627201,
                           0.001736648,  -0.0021148,   -0.000008097,  //
                           -0.074190686, 0.284149386,  0.001627201,  0.124215375,
                           0.003107495,  0.003351343,  -0.000020804,  //
                           -0.001160927, 0.004213192,  0.001736648,  0.003107495,
                           0.001014168,  0.000174341,  0.000063164,  //
                           0.000459017,  0.003378153,  -0.0021148,   0.003351343,
                           0.000174341,  0.000766587,  -0.000000437,  //
                           0.000036593,  0.000007604,  -0.000008097, -0.000020804,
                           0.000063164,  -0.000000437, 0.000076142};
  return arm.joints() == 4 ? wam4 : wam7;
}

/// At zero.
const Vector& golden_diagonal(const ArmNumbers& arm) {
  static const Vector wam4{0.138278983, 0.812415309, 0.005430255, 0.041188773};
  static const Vector wam7{0.139901939, 1.885267476, 0.007053211, 0.126107803,
                           0.000838925, 0.000766648, 0.000076142};
  return arm.joints() == 4 ? wam4 : wam7;
}

/// Positions, velocities and accelerations all over their ranges, the same in every run.
class Motions {
 public:
  Vector next(std::size_t joints, double range) {
    Vector numbers(joints);
    for (double& number : numbers) number = range * uniform_(engine_);
    return numbers;
  }

 private:
  std::mt19937 engine_{2008};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

Vector joined(const Vector& q, const Vector& qd, const Vector& qdd) {
  Vector motion = q;
  motion.insert(motion.end(), qd.begin(), qd.end());
  motion.insert(motion.end(), qdd.begin(), qdd.end());
  return motion;
}

class Dynamics : public ::testing::TestWithParam<const ArmNumbers*> {
 protected:
  const ArmNumbers& arm = *GetParam();
  control::InverseDynamics links = dynamics_of(arm);
};
INSTANTIATE_TEST_SUITE_P(Wam, Dynamics, ::testing::Values(&wam4(), &wam7()), name_of_arm);

TEST_P(Dynamics, TheToolIsWhereTheFactsHaveIt) {
  base::Diagnostics diagnostics;
  auto kinematics =
      control::ForwardKinematics::load(description_of(arm), {.tip_link = "tool"}, diagnostics);
  ASSERT_TRUE(kinematics) << diagnostics.to_text();
  for (const Golden& golden : golden_of(arm)) {
    control::Pose pose;
    ASSERT_TRUE(kinematics->step(golden.q, pose));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(pose.position[axis], golden.tool[axis], kDigits);
    }
  }
}

TEST_P(Dynamics, GravityIsCompensatedAsTheFactsHaveIt) {
  for (const Golden& golden : golden_of(arm)) {
    Vector torque(arm.joints());
    ASSERT_TRUE(links.gravity(golden.q, torque));
    EXPECT_LT(largest_difference(torque, golden.gravity), kDigitsOfTorque);
  }
}

TEST_P(Dynamics, TheMassMatrixIsThatOfTheFacts) {
  const std::size_t joints = arm.joints();
  Vector matrix(joints * joints);
  ASSERT_TRUE(links.mass_matrix(golden_of(arm).back().q, matrix));
  EXPECT_LT(largest_difference(matrix, golden_mass_matrix(arm)), kDigits);
  ASSERT_TRUE(links.mass_matrix(Vector(joints, 0.0), matrix));
  for (std::size_t i = 0; i < joints; ++i) {
    EXPECT_NEAR(matrix[i * joints + i], golden_diagonal(arm)[i], kDigits);
  }
}

/// MuJoCo's model of the same description.
class MujocoArm {
 public:
  explicit MujocoArm(const ArmNumbers& arm) {
    std::array<char, 1000> error{};
    model_.reset(mj_loadXML(description_of(arm).c_str(), nullptr, error.data(),
                            static_cast<int>(error.size())));
    EXPECT_NE(model_, nullptr) << error.data();
    model_->opt.gravity[2] = -kGravity;
    model_->opt.disableflags |= mjDSBL_CONSTRAINT;
    data_.reset(mj_makeData(model_.get()));
  }

  /// MuJoCo computes principal axes of inertia to microradians only; these are exact.
  void set_exact_inertias(const ArmNumbers& arm) {
    const auto urdf = urdf::parseURDFFile(description_of(arm));
    ASSERT_NE(urdf, nullptr);
    for (std::size_t i = 1; i <= arm.joints(); ++i) {
      const int body = mj_name2id(model_.get(), mjOBJ_BODY, ("axis" + std::to_string(i)).c_str());
      ASSERT_GT(body, 0);
      set_exact_inertia(body, *urdf->getJoint("frame" + std::to_string(i)),
                        *urdf->getLink("link" + std::to_string(i))->inertial);
    }
  }

  /// mj_inverse
  Vector torques(const Vector& q, const Vector& qd, const Vector& qdd) {
    std::copy(q.begin(), q.end(), data_->qpos);
    std::copy(qd.begin(), qd.end(), data_->qvel);
    std::copy(qdd.begin(), qdd.end(), data_->qacc);
    mj_inverse(model_.get(), data_.get());
    return {data_->qfrc_inverse, data_->qfrc_inverse + model_->nv};
  }

 private:
  void set_exact_inertia(int body, const urdf::Joint& frame, const urdf::Inertial& link) {
    Eigen::Matrix3d inertia;
    inertia << link.ixx, link.ixy, link.ixz,  //
        link.ixy, link.iyy, link.iyz,         //
        link.ixz, link.iyz, link.izz;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(inertia);
    Eigen::Matrix3d axes = principal.eigenvectors();
    if (axes.determinant() < 0.0) axes.col(0) *= -1.0;
    const urdf::Rotation& turned = frame.parent_to_joint_origin_transform.rotation;
    const Eigen::Quaterniond in_body =
        Eigen::Quaterniond(turned.w, turned.x, turned.y, turned.z) * Eigen::Quaterniond(axes);
    const double quaternion[] = {in_body.w(), in_body.x(), in_body.y(), in_body.z()};
    std::copy_n(quaternion, 4, model_->body_iquat + 4 * body);
    std::copy_n(principal.eigenvalues().data(), 3, model_->body_inertia + 3 * body);
    // MuJoCo looks for inertial frames that are the body's own.
    model_->body_sameframe[body] = 0;
  }

  struct Delete {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };
  std::unique_ptr<mjModel, Delete> model_;
  std::unique_ptr<mjData, Delete> data_;
};

/// The largest difference of the two inverse dynamics in many states all over the range, relative
/// to the torques of the state: in the norm of the largest magnitude among the joints.
double worst_difference(const ArmNumbers& arm, MujocoArm& mujoco, control::InverseDynamics& links) {
  Motions motions;
  Vector torques(arm.joints());
  double worst = 0.0;
  for (int i = 0; i < 10'000; ++i) {
    const Vector q = motions.next(arm.joints(), 3.0);
    const Vector qd = motions.next(arm.joints(), 3.0);
    const Vector qdd = motions.next(arm.joints(), 10.0);
    const Vector expected = mujoco.torques(q, qd, qdd);
    EXPECT_TRUE(links.step(joined(q, qd, qdd), torques));
    worst = std::max(worst, largest_difference(torques, expected) / largest(expected));
  }
  return worst;
}

TEST_P(Dynamics, TheInverseDynamicsAreThoseOfMujocoInTenThousandRandomStates) {
  MujocoArm mujoco(arm);
  mujoco.set_exact_inertias(arm);
  EXPECT_LT(worst_difference(arm, mujoco, links), 1e-9);
}

TEST_P(Dynamics, WithItsOwnPrincipalAxesMujocoIsStillSoNear) {
  MujocoArm mujoco(arm);
  EXPECT_LT(worst_difference(arm, mujoco, links), 1e-6);
}

}  // namespace
}  // namespace armature::wam
