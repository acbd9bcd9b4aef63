// SPDX-License-Identifier: Apache-2.0
// Starting and stopping components, on a robot that is none.
#include "armature/browser/internal/life_cycle.hpp"

#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::browser::internal {
namespace {

using ::testing::ElementsAre;

/// Its hardware takes so long to start that who reads it has stopped by then.
class SlowRobot final : public Robot {
 public:
  std::vector<std::string> component_names() override { return {"Reader", "Hardware", "Other"}; }
  std::string find(std::string_view text) override { return std::string(text); }
  std::string spelled(const std::string& component) const override { return component; }
  remote::ApplicationStatus status() override { return {}; }
  std::vector<remote::ComponentStatus> components() override {
    std::vector<remote::ComponentStatus> all;
    for (const std::string& name : component_names()) {
      remote::ComponentStatus status;
      status.name = name;
      status.state = states[name];
      status.autostart = true;
      status.start_order = static_cast<std::int32_t>(all.size());
      all.push_back(status);
    }
    return all;
  }
  remote::Faults faults() override { return {}; }
  remote::ComponentDetails look_at(const std::string&) override { return {}; }
  remote::ComponentDetails interface_of(const std::string&) override { return {}; }
  std::vector<remote::ItemValue> read(const std::vector<std::string>&, std::size_t) override {
    return {};
  }
  Changed change(const std::string& component, const std::string&) override {
    changed.push_back(component);
    if (component == "Other") return {"Other: it cannot", "Stopped"};
    states[component] = "Running";
    if (component == "Hardware") states["Reader"] = "Stopped";
    return {"", "Running"};
  }

  std::map<std::string, std::string> states{
      {"Reader", "Stopped"}, {"Hardware", "PreOperational"}, {"Other", "Stopped"}};
  std::vector<std::string> changed;
};

class Quiet final : public Surface {
 public:
  Paper paper() const override { return {}; }
  bool live() const override { return false; }
  void say(std::string_view) override {}
  void complain(std::string_view) override {}
  void show(std::string_view) override {}
  bool interrupted() const override { return false; }
  bool take_interrupt() override { return false; }
  void begin_keys() override {}
  bool take_key() override { return false; }
  void end_keys() override {}
};

TEST(LifeCycle, StartStartsThoseAgainThatStoppedWhileHardwareTookItsTime) {
  SlowRobot robot;
  Quiet quiet;
  Answers answers(quiet);
  LifeCycle life_cycle(robot, answers);
  life_cycle.start({});
  EXPECT_THAT(robot.changed, ElementsAre("Reader", "Hardware", "Other", "Reader"));
  EXPECT_EQ(robot.states["Reader"], "Running");
  EXPECT_EQ(answers.mistakes(), 1u) << "who refused is not asked again";
}

}  // namespace
}  // namespace armature::browser::internal
