// SPDX-License-Identifier: Apache-2.0
#include "armature/control/internal/urdf_chain.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <exception>
#include <fstream>
#include <iterator>
#include <set>
#include <string_view>

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include "armature/base/near_name.hpp"
#include "armature/base/quoted.hpp"

namespace armature::control::internal {
using base::quoted;

namespace {

using Links = std::vector<urdf::LinkConstSharedPtr>;

/// What the parser has to say goes to the diagnostics, not to the console. It also goes on after
/// some mistakes, such as an inertial element that it cannot read, and leaves out what is wrong.
class ParserMessages final : public console_bridge::OutputHandler {
 public:
  ParserMessages(const std::string& file, base::Diagnostics& diagnostics)
      : file_(file), diagnostics_(diagnostics) {
    console_bridge::useOutputHandler(this);
  }
  ~ParserMessages() override { console_bridge::restorePreviousOutputHandler(); }

  void log(const std::string& text, console_bridge::LogLevel level, const char* /*source*/,
           int /*line*/) override {
    if (level == console_bridge::CONSOLE_BRIDGE_LOG_ERROR) {
      diagnostics_.error({file_}, std::string(kExpected) + text);
    } else if (level == console_bridge::CONSOLE_BRIDGE_LOG_WARN) {
      diagnostics_.warning({file_}, text);
    }
  }

  inline static const std::string kExpected = "expected the description of a robot (URDF), found: ";

 private:
  const std::string& file_;
  base::Diagnostics& diagnostics_;
};

KDL::Vector to_kdl(const urdf::Vector3& vector) { return {vector.x, vector.y, vector.z}; }

KDL::Frame to_kdl(const urdf::Pose& pose) {
  const urdf::Rotation& rotation = pose.rotation;
  return {KDL::Rotation::Quaternion(rotation.x, rotation.y, rotation.z, rotation.w),
          to_kdl(pose.position)};
}

/// About the origin of the link, in its axes.
KDL::RigidBodyInertia to_kdl(const urdf::Inertial& inertial) {
  const KDL::RotationalInertia about_centre(inertial.ixx, inertial.iyy, inertial.izz, inertial.ixy,
                                            inertial.ixz, inertial.iyz);
  const KDL::RigidBodyInertia at_centre(inertial.mass, KDL::Vector::Zero(), about_centre);
  return to_kdl(inertial.origin) * at_centre;
}

bool is_body(const urdf::Inertial& inertial) {
  Eigen::Matrix3d inertia;
  inertia << inertial.ixx, inertial.ixy, inertial.ixz,  //
      inertial.ixy, inertial.iyy, inertial.iyz,         //
      inertial.ixz, inertial.iyz, inertial.izz;
  if (!std::isfinite(inertial.mass) || inertial.mass < 0.0 || !inertia.allFinite()) return false;
  const double rounding = 1e-9 * inertia.cwiseAbs().maxCoeff();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().minCoeff() >= -rounding;
}

bool is_fixed(const urdf::Joint& joint) { return joint.type == urdf::Joint::FIXED; }

bool turns(const urdf::Joint& joint) {
  return joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS;
}

/// Of what the description leaves out or gives as 0 nothing is known.
JointLimits limits_of(const urdf::Joint& joint) {
  JointLimits limits{.slides = joint.type == urdf::Joint::PRISMATIC};
  if (!joint.limits) return limits;
  if (joint.limits->lower < joint.limits->upper) {
    limits.lower = joint.limits->lower;
    limits.upper = joint.limits->upper;
  }
  if (joint.limits->velocity > 0.0) limits.max_velocity = joint.limits->velocity;
  if (joint.limits->effort > 0.0) limits.max_effort = joint.limits->effort;
  return limits;
}

/// Walks from the base link to the tip and makes a segment for each movable joint on the way.
class ChainReader {
 public:
  ChainReader(const urdf::ModelInterface& model, const UrdfQuery& query,
              base::Diagnostics& diagnostics)
      : model_(model), query_(query), diagnostics_(diagnostics) {}

  std::optional<UrdfChain> read() {
    const std::size_t errors_before = diagnostics_.error_count();
    const urdf::LinkConstSharedPtr base =
        query_.base_link.empty() ? model_.getRoot() : find(query_.base_link);
    if (!base || !mark_way_from(*base)) return std::nullopt;
    Part part = part_from(*base);
    while (choose_next(part)) {
      const Next next = part.next.front();
      part = part_from(*model_.getLink(next.joint->child_link_name));
      add_segment(next, part.inertia);
    }
    if (diagnostics_.error_count() > errors_before) return std::nullopt;
    if (!chain_.joints.empty()) return std::move(chain_);
    error("no joint moves between " + quoted(base->name) + " and the end of the robot",
          "expected at least one revolute, continuous or prismatic joint");
    return std::nullopt;
  }

 private:
  /// A movable joint, and where it is in the link that the part began with.
  struct Next {
    urdf::JointConstSharedPtr joint;
    KDL::Frame origin;
  };
  /// What moves as one body: a link and all that is fixed to it.
  struct Part {
    KDL::RigidBodyInertia inertia;
    std::vector<Next> next;
  };

  void error(const std::string& message, const base::Hint& hint = {}) {
    diagnostics_.error({query_.file}, message, hint);
  }
  void warning(const std::string& message, const base::Hint& hint = {}) {
    diagnostics_.warning({query_.file}, message, hint);
  }

  urdf::LinkConstSharedPtr find(const std::string& name) {
    if (auto link = model_.getLink(name)) return link;
    std::vector<std::string> names;
    for (const auto& [known, link] : model_.links_) names.push_back(known);
    error("unknown link " + quoted(name) + " in robot " + quoted(model_.getName()),
          base::suggestion(name, names));
    return nullptr;
  }

  /// Notes the joints between the base and the tip, if a tip was named.
  bool mark_way_from(const urdf::Link& base) {
    if (query_.tip_link.empty()) return true;
    urdf::LinkConstSharedPtr link = find(query_.tip_link);
    if (!link) return false;
    for (; link && link->name != base.name; link = link->getParent()) {
      if (link->parent_joint) way_.insert(link->parent_joint->name);
    }
    if (link) return true;
    error("link " + quoted(query_.tip_link) + " does not hang on link " + quoted(base.name),
          "base_link has to be on the way from the root to tip_link");
    return false;
  }

  Part part_from(const urdf::Link& link) {
    Part part;
    add(link, KDL::Frame::Identity(), part);
    return part;
  }

  void add(const urdf::Link& link, const KDL::Frame& where, Part& part) {
    if (!seen_.insert(link.name).second) {
      error("link " + quoted(link.name) + " is the child of two joints", "expected a tree");
      return;
    }
    if (link.name == query_.tip_link) chain_.tip = where;
    if (link.inertial && is_body(*link.inertial)) {
      part.inertia = part.inertia + where * to_kdl(*link.inertial);
    } else if (link.inertial) {
      error("the inertial element of link " + quoted(link.name) + " is physically impossible",
            "expected a mass of at least 0 and a positive semidefinite inertia");
    }
    for (const urdf::JointSharedPtr& joint : link.child_joints) {
      const KDL::Frame origin = where * to_kdl(joint->parent_to_joint_origin_transform);
      if (leads_on(*joint)) {
        part.next.push_back({joint, origin});
      } else {
        add(*model_.getLink(joint->child_link_name), origin, part);
      }
    }
  }

  bool leads_on(const urdf::Joint& joint) {
    if (is_fixed(joint)) return false;
    if (query_.tip_link.empty() || way_.count(joint.name) > 0) return true;
    warning("joint " + quoted(joint.name) + " is not on the way to " + quoted(query_.tip_link) +
            ": it counts as fixed at 0");
    return false;
  }

  /// False at the end of the chain, and if it is not clear where it goes on.
  bool choose_next(const Part& part) {
    if (part.next.empty()) return false;
    if (part.next.size() == 1) return is_usable(*part.next.front().joint);
    std::string names;
    for (const Next& each : part.next) {
      names += (names.empty() ? "" : ", ") + quoted(each.joint->name);
    }
    error("the robot branches: joints " + names + " branch from one link, expected a chain",
          "name the end of the chain with tip_link");
    return false;
  }

  bool is_usable(const urdf::Joint& joint) {
    const std::string name = "joint " + quoted(joint.name);
    if (!turns(joint) && joint.type != urdf::Joint::PRISMATIC) {
      error(name + " is floating or planar", "expected revolute, continuous, prismatic or fixed");
    } else if (joint.mimic) {
      error(name + " mimics joint " + quoted(joint.mimic->joint_name),
            "expected joints that move independently");
    } else if (to_kdl(joint.axis).Norm() == 0.0) {
      error(name + " has the axis 0 0 0", "expected a direction");
    } else {
      return true;
    }
    return false;
  }

  void add_segment(const Next& next, const KDL::RigidBodyInertia& inertia) {
    const KDL::Vector axis = next.origin.M * to_kdl(next.joint->axis);
    const auto kind = turns(*next.joint) ? KDL::Joint::RotAxis : KDL::Joint::TransAxis;
    const KDL::Joint joint(next.joint->name, next.origin.p, axis, kind);
    chain_.segments.addSegment(
        KDL::Segment(next.joint->child_link_name, joint, next.origin, inertia));
    chain_.joints.push_back(next.joint->name);
    chain_.limits.push_back(limits_of(*next.joint));
    if (inertia.getMass() == 0.0) {
      warning("nothing that moves with joint " + quoted(next.joint->name) + " has a mass",
              "give link " + quoted(next.joint->child_link_name) + " an inertial element");
    }
  }

  const urdf::ModelInterface& model_;
  const UrdfQuery& query_;
  base::Diagnostics& diagnostics_;
  std::set<std::string> way_;   ///< joints between base and tip
  std::set<std::string> seen_;  ///< links
  UrdfChain chain_;
};

/// Nothing after an error.
urdf::ModelInterfaceSharedPtr parse(const std::string& text, const UrdfQuery& query,
                                    base::Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  const ParserMessages messages(query.file, diagnostics);
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& exception) {
    diagnostics.error({query.file}, std::string(ParserMessages::kExpected) + exception.what());
  }
  const bool complained = diagnostics.error_count() > errors_before;
  if (!model && !complained) {
    diagnostics.error({query.file}, std::string(ParserMessages::kExpected) + "something else");
  }
  return complained ? nullptr : model;
}

}  // namespace

std::optional<std::string> read_description(const std::string& file,
                                            base::Diagnostics& diagnostics) {
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.bad() && stream.is_open()) return text;
  diagnostics.error({file}, "cannot be read, expected the description of a robot (URDF)",
                    "give the path of a file that exists");
  return std::nullopt;
}

std::optional<UrdfChain> read_urdf(const std::string& text, const UrdfQuery& query,
                                   base::Diagnostics& diagnostics) {
  const auto model = parse(text, query, diagnostics);
  if (!model) return std::nullopt;
  return ChainReader(*model, query, diagnostics).read();
}

}  // namespace armature::control::internal
