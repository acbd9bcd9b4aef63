// SPDX-License-Identifier: Apache-2.0
// What a deployment written from a table of a paper needs: priorities of RTAI, warnings that it
// means, and inputs that the operator writes.
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/interface.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/deploy/internal/test_models.hpp"
#include "armature/exec/inlets.hpp"
#include "armature/inspect/acts.hpp"

namespace armature::deploy {
namespace {

using ::testing::HasSubstr;
using namespace std::chrono_literals;

/// An input of which a voltage follows.
class Drive final : public component::Component {
 public:
  using Component::Component;

 private:
  component::InputPort<double> in_{this, "In", "an angle", "rad", component::may_stay_open};
  component::OutputPort<double> out_{this, "Out", "for a motor", "V"};
};

/// Keeps something from falling, by a bus of its own: no port tells.
class Keeper final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Reason held() { return component::Reason("a load"); }
  component::InputPort<double> in_{this, "In", "an angle", "rad", component::may_stay_open};
  component::Holding holding_{this, component::serve<&Keeper::held>};
};

Deployment deployment(const std::string& text) {
  DeploymentOptions options;
  options.cpus = 2;
  options.models = [](component::Registry& models) {
    test::add_models(models);
    models.add<Drive>("Drive", "turns a motor", {});
    models.add<Keeper>("Keeper", "holds a load", {});
  };
  return parse_deployment(text, "robot.yaml", options);
}

std::string messages(const std::string& text) { return deployment(text).diagnostics.to_text(); }

constexpr const char* kInverted = R"(
components:
  A: {model: Source, activity: {periodic: 10 ms, priority: 50}}
  B: {model: Echo, activity: {triggered: true, priority: 80}}
connections: [A.Out -> B.In]
)";

TEST(AcceptedWarning, IsANoteAndTheDeploymentPasses) {
  EXPECT_THAT(messages(kInverted), HasSubstr(": warning: 'B' (priority 80) is triggered by 'A'"));
  EXPECT_THAT(messages(kInverted), HasSubstr("[priority_inversion]"));
  const std::string accepted = messages(std::string("accept: [priority_inversion]") + kInverted);
  EXPECT_THAT(accepted, HasSubstr(": note: accepted: 'B' (priority 80) is triggered by 'A'"));
  EXPECT_THAT(accepted, ::testing::Not(HasSubstr("warning")));
}

TEST(AcceptedWarning, ThatIsUnknownIsAnErrorAndOneThatDoesNotOccurIsTold) {
  EXPECT_THAT(messages(std::string("accept: [priority_inversoin]") + kInverted),
              HasSubstr("error: unknown warning 'priority_inversoin' in accept (did you mean "
                        "'priority_inversion'?)"));
  EXPECT_THAT(messages(std::string("accept: [priority_inversion, missing_cpu]") + kInverted),
              HasSubstr("warning: accept names 'missing_cpu', but there is no such warning"));
}

TEST(AcceptedWarning, IsNeverAnError) {
  base::Diagnostics diagnostics;
  diagnostics.add({base::Severity::kError, {}, "wrong", "", {}, 0, "priority_inversion"});
  EXPECT_FALSE(diagnostics.accept("priority_inversion"));
  EXPECT_FALSE(diagnostics.ok());
}

TEST(PrioritiesOfRtai, KeepTheirOrder) {
  const Deployment table = deployment(R"(
priorities: rtai
components:
  First: {model: Source, activity: {periodic: 10 ms, priority: 1}}
  Second: {model: Source, activity: {periodic: 10 ms, priority: 97}}
  Equal: {model: Source, activity: {periodic: 10 ms, priority: 97}}
  Last: {model: Source, activity: {periodic: 10 ms, priority: 255}}
)");
  ASSERT_TRUE(table.ok()) << table.diagnostics.to_text();
  std::map<std::string, int> priorities;
  for (const auto& entry : table.blueprint.components) {
    priorities[entry.component->name()] = entry.activity.priority;
  }
  EXPECT_EQ(priorities, (std::map<std::string, int>{
                            {"First", 80}, {"Second", 79}, {"Equal", 79}, {"Last", 78}}));
}

TEST(PrioritiesOfRtai, NobodyLosesRealTimeForANumberThatIsMissing) {
  EXPECT_THAT(messages("priorities: rtai\ncomponents: {A: {model: Source, activity: {periodic: 10 "
                       "ms}}}\n"),
              HasSubstr("error: 'A' has a thread without a priority, but priorities are RTAI's"));
  EXPECT_EQ(
      messages("priorities: rtai\ncomponents: {A: {model: Source, activity: {periodic: 10 ms, "
               "scheduler: other}}}\n"),
      "");
  EXPECT_THAT(messages("components: {A: {model: Source, activity: {periodic: 10 ms, priority: "
                       "100}}}\n"),
              HasSubstr("priority must be a whole number from 1 to 99, found '100'"));
}

TEST(InputOfTheOperator, IsWrittenWhileTheApplicationRuns) {
  Deployment opened = deployment("operator_inputs: [B.In]\ncomponents: {B: {model: Echo}}\n");
  ASSERT_TRUE(opened.ok()) << opened.diagnostics.to_text();
  opened.options.simulated = true;
  exec::Application application(std::move(opened.blueprint), opened.options);
  ASSERT_TRUE(application.start().ok());
  const component::InputPortBase& input =
      *component::interface_of(*application.find("B")).inputs.front();
  ASSERT_TRUE(exec::write_for_operator(application, input, types::Value::of(1.5)));
  application.run_for(10ms);
  EXPECT_EQ(application.value_of("B", "In").value().text(), "1.5");
}

TEST(InputOfTheOperator, MayNotLeadToAnEffortNorHaveAWriter) {
  EXPECT_THAT(messages("operator_inputs: [D.In]\ncomponents: {D: {model: Drive}}\n"),
              HasSubstr("error: 'D.In' leads to 'D.Out': the operator may write only what moves "
                        "nothing"));
  EXPECT_THAT(
      messages("operator_inputs: [B.In]\ncomponents: {B: {model: Echo}, D: {model: Drive}}\n"
               "connections: [B.Out -> D.In]\n"),
      HasSubstr("error: 'B.In' leads to 'D.Out' by 'B'"));
  EXPECT_FALSE(deployment(R"(
operator_inputs: [B.In]
components: {A: {model: Source, activity: {periodic: 10 ms}}, B: {model: Echo}}
connections: [A.Out -> B.In]
)")
                   .ok());
}

TEST(InputOfTheOperator, MayNotLeadToWhatHoldsSomething) {
  EXPECT_THAT(messages("operator_inputs: [B.In]\ncomponents: {B: {model: Echo}, K: {model: "
                       "Keeper}}\nconnections: [B.Out -> K.In]\n"),
              HasSubstr("error: 'B.In' leads to 'K', which holds something by 'B'"));
}

TEST(InputOfTheOperator, IsClosedToScriptsAndOtherProcesses) {
  Deployment opened = deployment("operator_inputs: [B.In]\ncomponents: {B: {model: Echo}}\n");
  opened.options.simulated = true;
  exec::Application application(std::move(opened.blueprint), opened.options);
  ASSERT_TRUE(application.start().ok());
  inspect::Member member;
  member.component = application.find("B");
  member.input = component::interface_of(*member.component).inputs.front();
  EXPECT_TRUE(inspect::check_settable(application, member, exec::Caller::kOperator));
  for (const exec::Caller caller : {exec::Caller::kScript, exec::Caller::kRemote}) {
    const auto refused = inspect::check_settable(application, member, caller);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error(), "'B.In' is an input of the operator: only the operator writes it");
  }
}

TEST(InputOfTheOperator, OfAnUnknownPortIsRefused) {
  EXPECT_THAT(messages("operator_inputs: [B.Inn]\ncomponents: {B: {model: Echo}}\n"),
              HasSubstr("error: 'B' has no input 'Inn' (did you mean 'In'?)"));
}

}  // namespace
}  // namespace armature::deploy
