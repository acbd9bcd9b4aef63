// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/robot/new_robot.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "armature/base/quoted.hpp"
#include "armature/cli/robot/figures.hpp"
#include "armature/cli/robot/joint_plan.hpp"
#include "armature/cli/robot/robot_templates.hpp"
#include "armature/cli/robot/serial_arm.hpp"
#include "armature/platform/file.hpp"

namespace armature::cli {
namespace {

using Plans = std::vector<JointPlan>;

constexpr double kPeriod = 0.002;  // s

/// [kg m^2] at the joint: of the arm that is written, as motors behind gears have it; a description
/// says nothing of it.
double rotor_inertia(const RobotWish& wish) { return wish.urdf.empty() ? 0.1 : 0.0; }

/// [kg m^2] of simulated motors where a description says nothing: without, light joints are not to
/// be simulated in steps.
constexpr double kLeastRotor = 0.01;

/// Libraries that Armature has: a deployment would find two of a name.
constexpr std::string_view kLibraries = " cia402 controls janus record robot rover wam ";

/// What the kinds of drives call things.
struct Kind {
  std::string_view joint;  ///< the model
  std::string_view demux;
  std::string_view command;
  std::string_view actuator;
  double delay_s;  ///< from a sample until the answer acts
};

Kind kind_of(DriveKind drive) {
  if (drive == DriveKind::kCia402) {
    return {"PositionJoint", "PositionNDemux", "DesiredPosition", "PositionActuator", 2 * kPeriod};
  }
  const double delay = drive == DriveKind::kCan ? 2 * kPeriod : 0.0;
  return {"TorqueJoint", "TorqueNDemux", "Torque", "TorqueActuator", delay};
}

/// One number a joint, as YAML and Lua have them: `1, 2.5, 3`.
std::string each(const Plans& plans, double JointPlan::*number) {
  std::string text;
  for (const JointPlan& plan : plans) {
    text += (text.empty() ? "" : ", ") + figures_of(plan.*number);
  }
  return text;
}

std::string in_list(const Plans& plans, double JointPlan::*number) {
  return "[" + each(plans, number) + "]";
}

std::string joint_lines(const Plans& plans, bool by_torque) {
  std::string text;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const JointPlan& plan = plans[i];
    text +=
        "  Joint" + std::to_string(i + 1) + ": {override: true, properties: {" +
        (plan.continuous ? "Continuous: true"
                         : "PositionMin: " + figures_of(plan.lower) +
                               ", PositionMax: " + figures_of(plan.upper)) +
        ", MaxVelocity: " + figures_of(plan.max_velocity) +
        ", MaxAcceleration: " + figures_of(plan.max_acceleration) +
        (by_torque ? ", MaxTorque: " + figures_of(plan.max_torque) : ", MaxPositionError: 3 deg") +
        (!by_torque && plan.start != 0.0 ? ", InitialPos: " + figures_of(plan.start) : "") + "}}\n";
  }
  return text;
}

std::string controller_lines(const Plans& plans, bool by_torque) {
  if (!by_torque) {
    return "  # The drives follow positions by gains of their own.\n"
           "  Controller: {model: ControllerNPosition, peers: [Sampler, Arming], properties: "
           "{joints: "
           "\"${joints}\"}}\n";
  }
  return "  # Kp = w^2 I and Kd = 2 w I: both poles at -w as far as the sampled loop has a margin "
         "in "
         "all poses. The check tries it anew.\n"
         "  Controller:\n"
         "    model: ControllerGravityPD\n"
         "    peers: [Sampler, Arming]\n"
         "    properties:\n"
         "      joints: \"${joints}\"\n"
         "      robot_description: \"${here}/@name@.urdf\"\n"
         "      Kp: " +
         in_list(plans, &JointPlan::kp) + "\n      Kd: " + in_list(plans, &JointPlan::kd) + "\n";
}

std::string nodes_up_to(std::size_t joints) {
  std::string text;
  for (std::size_t i = 1; i <= joints; ++i) text += (i > 1 ? ", " : "") + std::to_string(i);
  return text;
}

/// Names of components, as C++ has them: `"Drive1", "Drive2"`.
std::string hardware_of(std::size_t joints) {
  std::string text;
  for (std::size_t i = 1; i <= joints; ++i) {
    text += (i > 1 ? ", " : "") + ("\"Drive" + std::to_string(i)) + "\"";
  }
  return text;
}

/// What the test of a new robot knows of its kind of drives.
std::string case_lines(DriveKind drive, std::size_t joints) {
  if (drive != DriveKind::kCia402) return {};
  return "  robot.mend = [](exec::Application& application) {\n"
         "    for (int node = 1; node <= " +
         std::to_string(joints) +
         "; ++node) {\n"
         "      static_cast<void>(application.call(\"Bus\", \"resetDrive\", "
         "{types::Value::of(node)}));\n"
         "    }\n"
         "  };\n";
}

constexpr std::string_view kPromisesBuild = R"(find_package(GTest)
if(GTest_FOUND)
  add_executable(@name@_promises promises_test.cpp)
  target_link_libraries(@name@_promises PRIVATE armature::deploy GTest::gtest_main)
  target_compile_definitions(@name@_promises PRIVATE ROBOT_FOLDER="${PROJECT_SOURCE_DIR}"
                                                     LIBRARY_FOLDER="${ARMATURE_COMPONENT_FOLDER}")
  add_test(NAME @name@_promises COMMAND @name@_promises)
else()
  message(STATUS "No GoogleTest (Debian: libgtest-dev), so @name@_promises is not built")
endif()
)";

Words words_for(const RobotWish& wish, const std::string& library, const Plans& plans) {
  const Kind kind = kind_of(wish.drive);
  const bool by_torque = wish.drive != DriveKind::kCia402;
  const Words name{{"name", library}};
  return {
      {"name", library},
      {"Name", camel_case(wish.name)},
      {"joints", std::to_string(plans.size())},
      {"nodes", nodes_up_to(plans.size())},
      {"joint", std::string(kind.joint)},
      {"demux", std::string(kind.demux)},
      {"command", std::string(kind.command)},
      {"actuator", std::string(kind.actuator)},
      {"drive", by_torque ? camel_case(wish.name) + "Drive" : "Cia402Drive"},
      {"libraries", by_torque ? "\"${here}/build/lib/armature/lib" + library + ".so\"" : "cia402"},
      {"rotor", figures_of(rotor_inertia(wish))},
      {"simulated_rotor", figures_of(std::max(rotor_inertia(wish), kLeastRotor))},
      {"delay", figures_of(kind.delay_s)},
      {"hardware", hardware_of(plans.size())},
      {"case", case_lines(wish.drive, plans.size())},
      {"promises", filled(kPromisesBuild, name)},
      {"joint_lines", joint_lines(plans, by_torque)},
      {"controller", filled(controller_lines(plans, by_torque), name)},
      {"max_vel", in_list(plans, &JointPlan::motion_velocity)},
      {"max_acc", in_list(plans, &JointPlan::motion_acceleration)},
      {"lower", in_list(plans, &JointPlan::lower)},
      {"upper", in_list(plans, &JointPlan::upper)},
      {"start", each(plans, &JointPlan::start)},
      {"target", each(plans, &JointPlan::target)},
      {"torques", in_list(plans, &JointPlan::max_torque)}};
}

base::Result<std::string> description_of(const RobotWish& wish, const std::string& library) {
  if (wish.urdf.empty()) return serial_arm(library, wish.joints);
  return platform::read_file(wish.urdf);
}

std::string problem_of(const RobotWish& wish, const std::string& library) {
  if (const std::string problem = problem_of_name(wish.name); !problem.empty()) {
    return "the name " + base::quoted(wish.name) + " " + problem;
  }
  if (kLibraries.find(" " + library + " ") != std::string_view::npos) {
    return "the name " + base::quoted(wish.name) +
           " is that of a library of Armature; choose another, such as " +
           base::quoted("my_" + library);
  }
  if (wish.joints >= 1 && wish.joints <= kMostNewJoints) return {};
  return "expected 1 to " + std::to_string(kMostNewJoints) + " joints, found " +
         std::to_string(wish.joints);
}

}  // namespace

base::Result<NewFolder> make_robot(const RobotWish& wish, const std::string& parent) {
  const std::string library = snake_case(wish.name);
  if (std::string problem = problem_of(wish, library); !problem.empty()) {
    return base::Error{std::move(problem)};
  }
  const auto urdf = description_of(wish, library);
  if (!urdf) return base::Error{urdf.error()};
  const JointDrive drive{.period_s = kPeriod,
                         .delay_s = kind_of(wish.drive).delay_s,
                         .rotor_inertia = rotor_inertia(wish),
                         .closed_here = wish.drive != DriveKind::kCia402};
  const auto plans = plan_joints(urdf.value(), wish.urdf.empty() ? library + ".urdf" : wish.urdf,
                                 wish.joints, drive);
  if (!plans) return base::Error{plans.error()};
  const Words words = words_for(wish, library, plans.value());
  std::vector<NewFile> files{{library + ".urdf", urdf.value()}};
  for (const auto templates : {robot_templates(), drive_templates(wish.drive)}) {
    for (const FileTemplate& file : templates) {
      files.push_back({filled(file.name, words), filled(file.content, words)});
    }
  }
  return make_folder(parent, library, files);
}

}  // namespace armature::cli
