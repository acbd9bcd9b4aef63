// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "armature/cli/commands.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/cli/new_component.hpp"
#include "armature/cli/robot/new_robot.hpp"

namespace armature::cli {
namespace {

int tell(const base::Result<NewFolder>& made, const Console& console) {
  if (!made) {
    console.say(rt::LogLevel::kError, made.error());
    return kFailed;
  }
  for (const std::string& file : made.value().files) {
    console.print(made.value().folder + "/" + file + "\n");
  }
  console.say(rt::LogLevel::kInfo,
              "made " + made.value().folder + "; its README.md says how to build");
  return kDone;
}

int new_component(const std::string& name, const Console& console) {
  return tell(make_component_library(name, "."), console);
}

int new_robot(const RobotWish& wish, const Console& console) {
  return tell(make_robot(wish, "."), console);
}

void add_new_component(CLI::App& parent, const CommandLine& to) {
  CLI::App* made = parent.add_subcommand("component", "a component library that builds");
  const auto name = arguments_of(*made, to, new_component);
  made->add_option("name", *name, "the name of the component, such as GripperDriver")->required();
}

void add_new_robot(CLI::App& parent, const CommandLine& to) {
  CLI::App* made = parent.add_subcommand("robot", "an arm that moves in simulation");
  const auto wish = arguments_of(*made, to, new_robot);
  made->add_option("name", wish->name, "the name of the robot, such as MyArm")->required();
  made->add_option("--joints", wish->joints, "how many joints it has, 1 to 7")->required();
  const std::map<std::string, DriveKind> kinds{
      {"cia402", DriveKind::kCia402}, {"can", DriveKind::kCan}, {"none", DriveKind::kNone}};
  made->add_option("--drive",
                   "cia402: drives on CANopen; can: a protocol of yours on CAN; none: "
                   "your own class")
      ->required()
      ->check(one_of({"cia402", "can", "none"}))
      ->each([wish, kinds](const std::string& kind) { wish->drive = kinds.at(kind); });
  made->add_option("--urdf", wish->urdf, "its description; without it a serial arm is written");
}

}  // namespace

void add_new(const CommandLine& to) {
  CLI::App* command = to.app.add_subcommand("new", "creates something to start from");
  command->require_subcommand(1);
  add_new_component(*command, to);
  add_new_robot(*command, to);
}

}  // namespace armature::cli
