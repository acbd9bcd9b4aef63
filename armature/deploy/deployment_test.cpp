// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/deployment.hpp"

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/deploy/internal/test_models.hpp"

namespace armature::deploy {

using namespace document;
namespace {

using namespace std::chrono_literals;

/// Forgets slowly what it reads, and keeps every bit of each result with its time.
class Recorder final : public component::Component {
 public:
  using Component::Component;
  std::vector<std::uint64_t> bits;

 private:
  component::Outcome on_configure() override {
    bits.reserve(100000);
    return component::accepted();
  }
  void on_update() override {
    mean_ += (in_.read().value - mean_) / 3.0;
    std::uint64_t result = 0;
    std::memcpy(&result, &mean_, sizeof result);
    bits.push_back(static_cast<std::uint64_t>(time().time_since_epoch().count()));
    bits.push_back(result);
  }

  component::InputPort<double> in_{this, "In", "an angle", "rad"};
  double mean_ = 0.0;
};

/// Three threads of different periods and priorities, two of which read what the others write.
std::vector<std::uint64_t> simulated_run() {
  DeploymentOptions options;
  options.models = [](component::Registry& models) {
    test::add_models(models);
    models.add<Recorder>("Recorder", "keeps what it reads");
  };
  Deployment deployment = parse_deployment(R"(
components:
  Slow: {model: Source, activity: {periodic: 7 ms, priority: 70}, properties: {Rate: 0.1}}
  Echo: {model: Echo}
  Early: {model: Recorder, activity: {periodic: 2 ms, priority: 80}}
  Late: {model: Recorder, activity: {periodic: 3 ms}}
connections:
  - Slow.Out -> Early.In
  - Slow.Out -> Echo.In
  - Echo.Out -> Late.In
)",
                                           "app.yaml", options);
  EXPECT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  const auto& early = test::get<Recorder>(deployment, "Early");
  const auto& late = test::get<Recorder>(deployment, "Late");
  deployment.options.simulated = true;
  exec::Application application(std::move(deployment.blueprint), deployment.options);
  EXPECT_TRUE(application.start().ok());
  application.run_for(1s);
  std::vector<std::uint64_t> all = early.bits;
  all.insert(all.end(), late.bits.begin(), late.bits.end());
  return all;
}

TEST(SimulatedDeployment, TwoRunsAreEqualToTheLastBit) {
  const std::vector<std::uint64_t> first = simulated_run();
  EXPECT_EQ(first.size(), 2u * (500 + 333));
  for (int run = 0; run < 5; ++run) EXPECT_EQ(simulated_run(), first);
}

TEST(LoadDeployment, AFileThatIsNotThereIsNamedWithTheReason) {
  const Deployment deployment = load_deployment("/nowhere/robot.yaml");
  EXPECT_EQ(deployment.diagnostics.to_text(),
            "error: cannot read '/nowhere/robot.yaml': No such file or directory\n");
}

TEST(LoadDeployment, AFileWithoutComponentsIsAMistake) {
  for (const char* text : {"", "# nothing yet\n", "application: empty\n"}) {
    EXPECT_EQ(parse_deployment(text, "robot.yaml").diagnostics.to_text(),
              "robot.yaml: error: the file has no components (add them under components:)\n");
  }
}

TEST(LoadDeployment, WhoIsNeverRunIsWarnedOf) {
  DeploymentOptions options;
  options.models = [](component::Registry& registry) {
    test::add_models(registry);
    registry.add<Recorder>("Recorder", "records what it reads");
  };
  const Deployment deployment = parse_deployment(R"(components:
  S: {model: Source, activity: {periodic: 7 ms}}
  A: {model: Recorder}
connections: [S.Out -> A.In]
)",
                                                 "robot.yaml", options);
  EXPECT_THAT(deployment.diagnostics.to_text(),
              ::testing::HasSubstr(
                  "robot.yaml:3:3: warning: 'A' never runs: it has no "
                  "activity, and nothing triggers or calls it [idle_component] (give it an "
                  "activity, for example activity: {periodic: 10 ms})\n"));
}

base::Diagnostics with_threads(const std::string& how_many, const std::string& head) {
  DeploymentOptions options;
  options.models = test::add_models;
  return parse_deployment(head + "components:\n  \"S{1.." + how_many +
                              "}\": {model: Source, activity: {periodic: 7 ms}}\n",
                          "robot.yaml", options)
      .diagnostics;
}

TEST(LoadDeployment, MoreThanSixtyFourThreadsAreRefusedUnlessItSaysHowMany) {
  EXPECT_TRUE(with_threads("64", "").ok());
  EXPECT_THAT(with_threads("65", "").to_text(),
              ::testing::HasSubstr("robot.yaml: error: the application has 65 threads, expected at "
                                   "most 64"));
  EXPECT_TRUE(with_threads("65", "threads: 65\n").ok());
  EXPECT_THAT(with_threads("101", "threads: 100\n").to_text(),
              ::testing::HasSubstr("101 threads, expected at most 100"));
  EXPECT_FALSE(with_threads("2", "threads: 0\n").ok());
}

}  // namespace
}  // namespace armature::deploy
