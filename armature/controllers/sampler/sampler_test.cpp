// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/sampler/sampler.hpp"

#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/exec/application.hpp"
#include "armature/testing/harness.hpp"

namespace armature::controllers {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class SamplerTest : public ::testing::Test {
 protected:
  testing::Harness sampler{std::make_unique<Sampler>("Sampler")};
};

TEST_F(SamplerTest, BeginsASampleInEachCycle) {
  ASSERT_TRUE(sampler.start()) << sampler.reason();
  const auto& samples = sampler.record<>("Sample");
  sampler.run_cycles(3);
  EXPECT_EQ(samples.size(), 3u);
  EXPECT_EQ(sampler.output<std::uint64_t>("SamplePort"), 3u);
  EXPECT_EQ(sampler.writes("SamplePort"), 3u);
}

TEST_F(SamplerTest, TriggerBeginsASampleBetweenTwoCycles) {
  ASSERT_TRUE(sampler.start()) << sampler.reason();
  const auto& samples = sampler.record<>("Sample");
  sampler.run_cycles();
  ASSERT_TRUE(sampler.call("trigger"));
  EXPECT_EQ(samples.size(), 2u);
  EXPECT_EQ(sampler.output<std::uint64_t>("SamplePort"), 2u);
}

TEST_F(SamplerTest, TriggerDoesNothingButALogLineWhileItIsStopped) {
  ASSERT_TRUE(sampler.start()) << sampler.reason();
  const auto& samples = sampler.record<>("Sample");
  sampler.stop();
  ASSERT_TRUE(sampler.call("trigger"));
  EXPECT_EQ(samples.size(), 0u);
  EXPECT_THAT(sampler.log(),
              ElementsAre(HasSubstr("trigger: no sample while the sampler is Stopped")));
}

TEST_F(SamplerTest, CountsFromOneAgainAfterAStart) {
  ASSERT_TRUE(sampler.start()) << sampler.reason();
  sampler.run_cycles(5);
  sampler.stop();
  ASSERT_TRUE(sampler.start()) << sampler.reason();
  sampler.run_cycles();
  EXPECT_EQ(sampler.output<std::uint64_t>("SamplePort"), 1u);
}

/// Is sampled in its own thread, which has room for one sample.
class Slow final : public component::Component {
 public:
  using Component::Component;
  int samples = 0;

 private:
  void on_sample() { ++samples; }
  component::EventHandler<> sample_{this,
                                    "Sample",
                                    component::serve<&Slow::on_sample>,
                                    "counts",
                                    component::queue(1),
                                    component::leads_to_nothing()};
};

/// Triggers two samples within one cycle.
class Hasty final : public component::Component {
 public:
  using Component::Component;

 private:
  void on_update() override {
    trigger_();
    trigger_();
  }
  component::OperationCaller<void()> trigger_{this, "trigger", "begins a sample"};
};

TEST(SamplerInAnApplication, CountsASampleThatAHandlerHadNoRoomFor) {
  exec::Blueprint blueprint;
  blueprint.add<Sampler>("Sampler");
  auto& slow = blueprint.add<Slow>("Slow", exec::Activity::triggered());
  blueprint.components.back().peers.push_back({"Sampler", {}});
  blueprint.add<Hasty>("Hasty", exec::Activity::periodic(std::chrono::milliseconds(10)));
  blueprint.components.back().peers.push_back({"Sampler", {}});
  exec::ApplicationOptions options;
  options.simulated = true;
  exec::Application application(std::move(blueprint), options);
  const auto started = application.start();
  ASSERT_TRUE(started.ok()) << started.to_text();
  application.run_for(std::chrono::milliseconds(25));
  const auto undelivered = application.value_of("Sampler", "undelivered");
  ASSERT_TRUE(undelivered);
  EXPECT_GT(slow.samples, 0);
  EXPECT_EQ(undelivered.value().text(), std::to_string(slow.samples));
}

}  // namespace
}  // namespace armature::controllers
