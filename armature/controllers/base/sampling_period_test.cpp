// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/sampling_period.hpp"

#include <chrono>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/controllers/sampler/sampler.hpp"
#include "armature/exec/plan.hpp"

namespace armature::controllers {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

class Sampled final : public component::Component {
 public:
  using Component::Component;
  SamplingPeriod period{this};

 private:
  void on_sample() {}
  component::EventHandler<> sample_{this, "Sample", component::serve<&Sampled::on_sample>, "begins",
                                    component::optional};
};

class SamplingPeriodOfPlan : public ::testing::Test {
 protected:
  Sampled& add_sampled() { return blueprint.add<Sampled>("Joint"); }
  void sample_every(base::Duration period) {
    blueprint.add<Sampler>("Sampler", exec::Activity::periodic(period));
    blueprint.add_peer("Joint", "Sampler");
  }
  std::string problems() {
    base::Diagnostics diagnostics;
    exec::make_plan(blueprint, diagnostics);
    return diagnostics.to_text();
  }
  exec::Blueprint blueprint;
};

TEST_F(SamplingPeriodOfPlan, IsThatOfWhoSamplesIt) {
  const Sampled& joint = add_sampled();
  sample_every(2ms);
  EXPECT_EQ(problems(), "");
  EXPECT_EQ(joint.period.duration(), 2ms);
  EXPECT_DOUBLE_EQ(joint.period.seconds(), 0.002);
  EXPECT_TRUE(joint.period.known());
}

TEST_F(SamplingPeriodOfPlan, APropertyThatSaysTheSameIsNoMistake) {
  Sampled& joint = add_sampled();
  sample_every(2ms);
  EXPECT_TRUE(joint.period.property().set(types::Value::of(0.002)));
  EXPECT_EQ(problems(), "");
}

TEST_F(SamplingPeriodOfPlan, APropertyThatSaysAnotherOneIsRefusedWithBothFigures) {
  Sampled& joint = add_sampled();
  sample_every(20ms);
  EXPECT_TRUE(joint.period.property().set(types::Value::of(0.002)));
  EXPECT_EQ(problems(),
            "error: 'Joint': Period is 2 ms, but 'Sampler' runs it every 20 ms (leave Period out, "
            "or give 'Sampler' activity: {periodic: 2 ms})\n");
  const component::Outcome known = joint.period.known();
  EXPECT_FALSE(known) << "nor is it configured";
  EXPECT_EQ(known.reason(), "Period is 2 ms, but it is run every 20 ms");
}

TEST_F(SamplingPeriodOfPlan, WhatNobodyPeriodicSamplesNeedsTheProperty) {
  Sampled& joint = add_sampled();
  EXPECT_THAT(
      problems(),
      HasSubstr(
          "'Joint': needs the period between two samples, but no periodic component triggers it"));
  EXPECT_FALSE(joint.period.known());
  EXPECT_TRUE(joint.period.property().set(types::Value::of(0.01)));
  EXPECT_EQ(problems(), "");
  EXPECT_EQ(joint.period.duration(), 10ms);
}

TEST_F(SamplingPeriodOfPlan, OfTwoPeriodsThePropertySaysWhichCounts) {
  Sampled& joint = add_sampled();
  const Sampler quick("Quick");
  const Sampler slow("Slow");
  component::Host::set_pace(joint, {2ms, &quick, 20ms, &slow});
  EXPECT_FALSE(joint.period.known());
  EXPECT_TRUE(joint.period.property().set(types::Value::of(0.02)));
  EXPECT_TRUE(joint.period.known());
  EXPECT_EQ(joint.period.duration(), 20ms);
  EXPECT_TRUE(joint.period.property().set(types::Value::of(0.01)));
  EXPECT_FALSE(joint.period.known());
}

}  // namespace
}  // namespace armature::controllers
