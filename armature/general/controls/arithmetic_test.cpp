// SPDX-License-Identifier: Apache-2.0
// Controls that compute.
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/exec/blueprint.hpp"
#include "armature/exec/plan.hpp"
#include "armature/general/controls/adder.hpp"
#include "armature/general/controls/comparator.hpp"
#include "armature/general/controls/constant.hpp"
#include "armature/general/controls/deviation.hpp"
#include "armature/general/controls/integrator.hpp"
#include "armature/general/controls/limit.hpp"
#include "armature/general/controls/multiplier.hpp"
#include "armature/general/controls/slider.hpp"
#include "armature/testing/harness.hpp"
#include "armature/testing/realtime_guard.hpp"

namespace armature::general {
namespace {

using namespace std::chrono_literals;
using testing::Harness;
using ::testing::HasSubstr;

template <typename Control>
Harness bench() {
  return Harness(std::make_unique<Control>("Control"));
}

TEST(Constant, WritesItsValueInEachCycle) {
  auto constant = bench<Constant>();
  constant.set("Value", 2.5);
  ASSERT_TRUE(constant.start());
  constant.run_cycles(3);
  EXPECT_EQ(constant.output<double>("Out"), 2.5);
  EXPECT_EQ(constant.writes("Out"), 3u);
}

TEST(Adder, AddsTheNewestValuesOnceAllAreThere) {
  auto adder = bench<Adder>();
  adder.set("Inputs", 3);
  adder.set("Signs", "[1, -1, 0.5]");
  ASSERT_TRUE(adder.start()) << adder.reason();
  adder.write("In1", 10.0);
  adder.write("In2", 3.0);
  EXPECT_EQ(adder.writes("Out"), 0u) << "In3 was not written yet";
  adder.write("In3", 4.0);
  EXPECT_EQ(adder.output<double>("Out"), 9.0);
  const testing::RealtimeGuard guard;
  adder.write("In2", 1.0);
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
  EXPECT_EQ(adder.output<double>("Out"), 11.0);
}

TEST(Adder, NeedsASignForEachInputIfThereAreAny) {
  auto adder = bench<Adder>();
  adder.set("Signs", "[1, -1, 1]");
  EXPECT_FALSE(adder.start());
  EXPECT_THAT(adder.reason(), HasSubstr("give each one"));
}

TEST(Deviation, IsThatOfTheShadowsValueFromTheNewestDrivingOne) {
  auto deviation = bench<Deviation>();
  ASSERT_TRUE(deviation.start()) << deviation.reason();
  deviation.write("Shadow", 1.0);
  EXPECT_EQ(deviation.writes("Difference"), 0u) << "nobody drives yet";
  deviation.write("Driving", 3.0);
  EXPECT_EQ(deviation.writes("Difference"), 0u) << "it waits for the shadow";
  deviation.write("Shadow", 5.5);
  EXPECT_EQ(deviation.output<double>("Difference"), 2.5);
  deviation.write("Shadow", 2.0);
  EXPECT_EQ(deviation.output<double>("Difference"), 1.0);
  EXPECT_EQ(deviation.output<double>("Largest"), 2.5);
}

TEST(Deviation, OfWhatIsNoNumberIsInfinite) {
  auto deviation = bench<Deviation>();
  ASSERT_TRUE(deviation.start()) << deviation.reason();
  deviation.write("Driving", 3.0);
  deviation.write("Shadow", std::numeric_limits<double>::quiet_NaN());
  deviation.write("Shadow", 3.0);
  EXPECT_EQ(deviation.output<double>("Difference"), 0.0);
  EXPECT_EQ(deviation.output<double>("Largest"), std::numeric_limits<double>::infinity());
}

TEST(Deviations, AreThoseOfTheElementsThatAreFurthestApart) {
  auto deviation = bench<Deviations>();
  deviation.set("Size", 2);
  ASSERT_TRUE(deviation.start()) << deviation.reason();
  deviation.write("Driving", std::vector{1.0, 2.0});
  deviation.write("Shadow", std::vector{1.5, -1.0});
  EXPECT_EQ(deviation.output<double>("Difference"), 3.0);
}

TEST(Multiplier, MultipliesOnceBothAreThere) {
  auto multiplier = bench<Multiplier>();
  ASSERT_TRUE(multiplier.start());
  multiplier.write("A", 3.0);
  EXPECT_EQ(multiplier.writes("Out"), 0u);
  multiplier.write("B", -2.0);
  EXPECT_EQ(multiplier.output<double>("Out"), -6.0);
}

TEST(Limit, KeepsAValueWithinItsBounds) {
  auto limit = bench<Limit>();
  limit.set("High", 2.0);
  ASSERT_TRUE(limit.start());
  limit.write("In", 5.0);
  EXPECT_EQ(limit.output<double>("Out"), 2.0);
  EXPECT_TRUE(limit.output<bool>("Clipped"));
  limit.write("In", 0.5);
  EXPECT_EQ(limit.output<double>("Out"), 0.5);
  EXPECT_FALSE(limit.output<bool>("Clipped"));
}

TEST(Limit, KeepsAValueWithinWhatIsTheMost) {
  auto limit = bench<Limit>();
  ASSERT_TRUE(limit.start());
  limit.write("Most", 0.25);
  limit.write("In", 0.5);
  EXPECT_EQ(limit.output<double>("Out"), 0.25);
  limit.write("In", -0.5);
  EXPECT_EQ(limit.output<double>("Out"), -0.25);
  limit.write("Most", 5.0);
  limit.write("In", 3.0);
  EXPECT_EQ(limit.output<double>("Out"), 1.0) << "Low and High hold besides";
}

TEST(Limit, DoesNotPassOnWhatIsNoNumber) {
  auto limit = bench<Limit>();
  ASSERT_TRUE(limit.start());
  limit.write("In", std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(limit.writes("Out"), 0u);
}

TEST(Integrator, SumsUpByTheTrapezoidalRuleWithinItsBounds) {
  auto integrator = bench<Integrator>();
  integrator.set("Initial", 1.0);
  integrator.set("High", 3.0);
  ASSERT_TRUE(integrator.start());
  integrator.write("In", 1.0);
  EXPECT_EQ(integrator.output<double>("Out"), 1.0);
  integrator.advance(500ms);
  integrator.write("In", 3.0);
  EXPECT_DOUBLE_EQ(integrator.output<double>("Out"), 2.0);
  integrator.advance(10s);
  integrator.write("In", 3.0);
  EXPECT_EQ(integrator.output<double>("Out"), 3.0) << "no wind-up beyond the bound";
  integrator.advance(500ms);
  integrator.write("In", -1.0);
  EXPECT_DOUBLE_EQ(integrator.output<double>("Out"), 3.0);
  ASSERT_TRUE(integrator.call("reset"));
  integrator.write("In", -1.0);
  EXPECT_EQ(integrator.output<double>("Out"), 1.0);
}

// --- units ---------------------------------------------------------------------------------------

/// What the check says of a control with these properties, and of a connection to it.
template <typename Control>
std::string check(const std::vector<std::pair<const char*, const char*>>& properties) {
  exec::Blueprint blueprint;
  Control& control = blueprint.add<Control>("Control");
  for (auto* property : component::interface_of(control).properties) {
    for (const auto& [name, text] : properties) {
      if (property->name() == name) EXPECT_TRUE(property->set(types::Value::of(std::string(text))));
    }
  }
  Constant& source = blueprint.add<Constant>("Source", exec::Activity::periodic(1ms));
  for (auto* property : component::interface_of(source).properties) {
    if (property->name() == "Unit") {
      EXPECT_TRUE(property->set(types::Value::of(std::string("rad"))));
    }
  }
  for (const auto* input : component::interface_of(control).inputs) {
    blueprint.connect("Source.Out", "Control." + input->name());
  }
  base::Diagnostics diagnostics;
  exec::make_plan(blueprint, diagnostics);
  return diagnostics.to_text();
}

TEST(UnitsOfControls, PortsAreInTheUnitThatThePropertySays) {
  EXPECT_EQ(check<Adder>({{"Unit", "rad"}}), "");
  EXPECT_THAT(check<Adder>({{"Unit", "m"}}),
              HasSubstr("'Source.Out' is in 'rad', but 'Control.In1' expects 'm'"));
  EXPECT_THAT(check<Adder>({}),
              HasSubstr("expects plain numbers (name the unit of 'Control': Unit: rad)"));
}

TEST(UnitsOfControls, WhatIsNoUnitIsRefused) {
  Limit control("Control");
  for (auto* property : component::interface_of(control).properties) {
    if (property->name() != "Unit") continue;
    EXPECT_EQ(property->set(types::Value::of(std::string("radd"))).error(),
              "property 'Unit' of 'Control' cannot be radd: unknown unit 'radd' (did you mean "
              "'rad'?)");
  }
}

/// The units of a control's properties, with `rad` as that of all units that it may be given.
template <typename Control>
std::string units_of_numbers() {
  Control control("Control");
  std::string units;
  for (auto* property : component::interface_of(control).properties) {
    if (property->name().starts_with("Unit")) {
      EXPECT_TRUE(property->set(types::Value::of(std::string("rad"))));
    } else if (property->type().kind == types::Kind::kDouble) {
      units += (units.empty() ? "" : " ") + std::string(property->name()) + "=" +
               std::string(property->unit());
    }
  }
  return units;
}

TEST(UnitsOfControls, NumbersAreInTheUnitThatThePropertySays) {
  EXPECT_EQ(units_of_numbers<Constant>(), "Value=rad");
  EXPECT_EQ(units_of_numbers<Limit>(), "Low=rad High=rad");
  EXPECT_EQ(units_of_numbers<Integrator>(), "Initial=rad Low=rad High=rad");
  EXPECT_EQ(units_of_numbers<Comparator>(), "Threshold=rad DeadBand=rad");
  EXPECT_EQ(units_of_numbers<Slider>(), "Low=rad High=rad Rest=rad Release=s");
}

TEST(UnitsOfControls, AProductHasTheUnitOfItsFactors) {
  EXPECT_EQ(check<Multiplier>({{"UnitA", "rad"}, {"UnitB", "rad"}, {"UnitOut", "rad^2"}}), "");
  EXPECT_THAT(check<Multiplier>({{"UnitA", "rad"}, {"UnitB", "rad"}, {"UnitOut", "rad"}}),
              HasSubstr("'rad' is not the unit of 'rad' times 'rad'"));
}

TEST(UnitsOfControls, AnIntegralHasTheUnitOfItsInputTimesSeconds) {
  EXPECT_EQ(check<Integrator>({{"UnitIn", "rad"}, {"UnitOut", "rad s"}}), "");
  EXPECT_THAT(check<Integrator>({{"UnitIn", "rad"}, {"UnitOut", "rad"}}),
              HasSubstr("'rad' is not the unit of 'rad' times 's'"));
}

}  // namespace
}  // namespace armature::general
