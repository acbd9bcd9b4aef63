// SPDX-License-Identifier: Apache-2.0
// Starting and stopping components, on a robot that is none.
#include "armature/browser/internal/life_cycle.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::browser::internal {
namespace {

using ::testing::ElementsAre;

using component::State;
using Texts = std::vector<std::string>;

/// Its hardware takes so long to start that who reads it has stopped by then.
class SlowRobot final : public inspect::View {
 public:
  std::vector<std::string> component_names() override { return {"Reader", "Hardware", "Other"}; }
  inspect::ApplicationStatus status() override { return {}; }
  std::vector<inspect::ComponentStatus> components(const Which& which) override {
    std::vector<inspect::ComponentStatus> all;
    for (const std::string& name : component_names()) all.push_back(status_of(name));
    std::erase_if(all, [&](const inspect::ComponentStatus& one) { return !which(one.name); });
    return all;
  }
  inspect::Faults faults(const Which&) override { return {}; }
  inspect::ComponentDescription describe(const std::string&, inspect::Values) override {
    return {};
  }
  std::vector<inspect::Connection> connections(const Which&) override { return {}; }
  std::vector<inspect::ItemValue> read(const std::vector<std::string>&) override { return {}; }
  inspect::ItemValue write(const std::string&, const std::string&) override { return {}; }
  inspect::CallResult call(const std::string&, const std::string&, const Texts&) override {
    return {};
  }
  inspect::CommandStatus begin(const std::string&, const std::string&, const Texts&) override {
    return {};
  }
  inspect::CommandStatus follow(std::int32_t) override { return {}; }
  inspect::CommandStatus cancel(std::int32_t) override { return {}; }
  inspect::ComponentStatus change(const std::string& component, inspect::LifeCycleChange) override {
    changed.push_back(component);
    if (component == "Other") throw inspect::Refusal("Other: it cannot");
    states[component] = State::kRunning;
    if (component == "Hardware") states["Reader"] = State::kStopped;
    return status_of(component);
  }
  inspect::Watch watch(const Texts&, base::Duration) override { return {}; }
  inspect::WatchedValues watched(std::int32_t) override { return {}; }
  void end_watch(std::int32_t) override {}
  inspect::Cycle cycle(const std::string&, const Which&) override { return {}; }
  inspect::LogLines log(std::uint64_t, const Which&) override { return {}; }
  exec::Pace pace() override { return {}; }
  exec::Pace set_pace(const exec::Pace& pace) override { return pace; }
  exec::Pace step() override { return {}; }

  std::map<std::string, State> states{{"Reader", State::kStopped},
                                      {"Hardware", State::kPreOperational},
                                      {"Other", State::kStopped}};
  std::vector<std::string> changed;

 private:
  inspect::ComponentStatus status_of(const std::string& name) {
    const std::vector<std::string> names = component_names();
    inspect::ComponentStatus status;
    status.name = name;
    status.state = states[name];
    status.autostart = true;
    status.start_order = static_cast<int>(std::ranges::find(names, name) - names.begin());
    return status;
  }
};

/// Names are spelled as they are, and there is nothing to say.
class NoLanguage final : public Language {
 public:
  const Vocabulary& vocabulary() const override { return plain_vocabulary(); }
  bool goes_on(std::string_view) const override { return false; }
  bool is_statement(std::string_view) const override { return false; }
  void take(std::string_view) override {}
  std::string plain(std::string_view text) const override { return std::string(text); }
  std::string spelled(const std::string& component) const override { return component; }
  std::vector<std::string> names_in(const std::string&) override { return {}; }
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
  const NoLanguage language;
  SpelledView view(robot, language);
  LifeCycle life_cycle(view, answers);
  life_cycle.start({});
  EXPECT_THAT(robot.changed, ElementsAre("Reader", "Hardware", "Other", "Reader"));
  EXPECT_EQ(robot.states["Reader"], State::kRunning);
  EXPECT_EQ(answers.mistakes(), 1u) << "who refused is not asked again";
}

}  // namespace
}  // namespace armature::browser::internal
