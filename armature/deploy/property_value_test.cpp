// SPDX-License-Identifier: Apache-2.0
#include "armature/document/property_value.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/base/fixed_text.hpp"
#include "armature/component/properties/property.hpp"
#include "armature/deploy/internal/test_models.hpp"
#include "armature/deploy/load.hpp"
#include "armature/orocos/property_file.hpp"
#include "armature/types/enum.hpp"
#include "armature/types/struct.hpp"

namespace armature::deploy {

using namespace document;

struct Gains {
  double kp = 0.0;
  double limit = 0.0;
};

ARMATURE_STRUCT(Gains, (kp, "V/rad"), (limit, "V"));

enum class Drive : std::uint8_t { kOff, kVelocity, kEffort };
ARMATURE_ENUM(Drive, kOff, kVelocity, kEffort);

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr int kLine = 3;

/// The value of a property as a deployment writes it.
Value written(const std::string& yaml) {
  base::Diagnostics diagnostics;
  const Document document =
      parse_document("components:\n  C: {model: M, properties: {\n    P: " + yaml + "}}\n",
                     "test.yaml", {}, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.to_text();
  return document.components.at(0).properties.at(0).value;
}

template <typename T>
T read(const std::string& yaml, std::string_view unit = {}) {
  base::Diagnostics diagnostics;
  const std::optional<types::Value> value =
      make_value(written(yaml), types::type_of<T>(), unit, "property 'P' of 'C'", diagnostics);
  EXPECT_TRUE(value.has_value()) << diagnostics.to_text();
  return value ? *value->template get_if<T>() : T{};
}

/// What is said of a value that cannot be read.
template <typename T>
std::string refusal(const std::string& yaml, std::string_view unit = {}) {
  base::Diagnostics diagnostics;
  const auto value =
      make_value(written(yaml), types::type_of<T>(), unit, "property 'P' of 'C'", diagnostics);
  EXPECT_FALSE(value.has_value()) << value->text();
  EXPECT_FALSE(diagnostics.ok());
  for (const base::Diagnostic& one : diagnostics.all()) EXPECT_EQ(one.where.line, kLine);
  return diagnostics.to_text();
}

TEST(PropertyValue, ANumberWithoutAUnitIsInThePropertysUnit) {
  EXPECT_EQ(read<double>("0.25", "V/rad"), 0.25);
  EXPECT_EQ(read<float>("-3"), -3.0f);
  EXPECT_EQ(read<double>("1e-3", "m"), 1e-3);
}

TEST(PropertyValue, ANumberWithAUnitIsConverted) {
  EXPECT_EQ(read<double>("10 ms", "s"), 0.01);
  EXPECT_EQ(read<double>("180 deg", "rad"), 3.14159265358979323846);
  EXPECT_EQ(read<int>("2 s", "ms"), 2000);
}

TEST(PropertyValue, AWrongKindOfUnitIsAnErrorThatNamesBoth) {
  EXPECT_EQ(refusal<double>("10 ms", "V"),
            "test.yaml:3:8: error: property 'P' of 'C': '10 ms': cannot convert 'ms' to 'V': the "
            "first is s, the second m^2 kg s^-3 A^-1\n");
}

TEST(PropertyValue, APlainNumberTakesNoUnit) {
  EXPECT_EQ(refusal<double>("10 ms"),
            "test.yaml:3:8: error: property 'P' of 'C': '10 ms' has the unit 'ms', but a plain "
            "number is expected\n");
}

// --- a unit that another property names ----------------------------------------------------------

/// Serves any unit.
class Goal final : public component::Component {
 public:
  using Component::Component;
  component::Property<std::string> unit{this, "Unit", "", "of the goal"};
  component::Property<double> goal{this, "Goal", 0.0, "where to", "", component::unit_of(unit)};
};

/// A deployment of one, with these properties.
Deployment with_goal(const std::string& properties) {
  DeploymentOptions options;
  options.models = [](component::Registry& models) { models.add<Goal>("Goal", "any unit"); };
  return parse_deployment(
      "components:\n  C: {model: Goal, activity: sequential, properties: {" + properties + "}}\n",
      "test.yaml", options);
}

double goal_of(const std::string& properties) {
  const Deployment deployment = with_goal(properties);
  EXPECT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  return test::get<Goal>(deployment, "C").goal;
}

std::string refusal_of_goal(const std::string& properties) {
  const Deployment deployment = with_goal(properties);
  EXPECT_FALSE(deployment.ok());
  EXPECT_EQ(deployment.diagnostics.all().size(), 1u);
  return deployment.diagnostics.to_text();
}

TEST(UnitOfAProperty, IsWhatAnotherOneSaysWhicheverIsWrittenFirst) {
  constexpr double kQuarter = 0.78539816339744830962;
  EXPECT_DOUBLE_EQ(goal_of("Unit: rad, Goal: 45 deg"), kQuarter);
  EXPECT_DOUBLE_EQ(goal_of("Goal: 45 deg, Unit: rad"), kQuarter);
  EXPECT_EQ(goal_of("Goal: 45, Unit: rad"), 45.0);
}

TEST(UnitOfAProperty, RefusesAnotherKindOfUnitAtItsPlace) {
  EXPECT_THAT(refusal_of_goal("Unit: rad, Goal: 45 V"),
              StartsWith("test.yaml:2:72: error: property 'Goal' of 'C': '45 V': cannot convert "
                         "'V' to 'rad'"));
}

TEST(UnitOfAProperty, IsAskedForWhereNothingNamesIt) {
  EXPECT_EQ(refusal_of_goal("Goal: 45 deg"),
            "test.yaml:2:61: error: property 'Goal' of 'C': '45 deg' has the unit 'deg', but a "
            "plain number is expected (name its unit: Unit: deg)\n");
}

TEST(UnitOfAProperty, ThatIsMistakenIsToldAndNotAlsoWhatDependsOnIt) {
  EXPECT_THAT(refusal_of_goal("Goal: 45 deg, Unit: [rad]"), HasSubstr("property 'Unit' of 'C'"));
}

TEST(PropertyValue, AnUnknownUnitIsNamed) {
  EXPECT_THAT(refusal<double>("10 parsecs", "m"), HasSubstr("'parsecs'"));
}

TEST(PropertyValue, WhatIsNoNumberIsRefused) {
  EXPECT_THAT(refusal<double>("fast", "m/s"), HasSubstr("found 'fast'"));
  EXPECT_THAT(refusal<int>("many"), HasSubstr("found 'many'"));
  EXPECT_THAT(refusal<double>("nan"), HasSubstr("found 'nan'"));
  EXPECT_THAT(refusal<double>("[1, 2]", "m"),
              HasSubstr("property 'P' of 'C': expected a number in m, found a list"));
}

TEST(PropertyValue, InfinityIsANumberForThoseWhoMeanNoLimit) {
  EXPECT_EQ(read<double>(".inf", "m/s"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(read<double>("-inf"), -std::numeric_limits<double>::infinity());
  EXPECT_THAT(refusal<int>("inf"), HasSubstr("expected a whole number"));
}

TEST(PropertyValue, IntegersAreWhole) {
  EXPECT_EQ(read<int>("4.0"), 4);
  EXPECT_EQ(read<int>("1e3"), 1000);
  EXPECT_EQ(read<std::uint16_t>("0x7ff"), 0x7ff);
  EXPECT_THAT(refusal<int>("2.5"), HasSubstr("expected a whole number, found '2.5'"));
  EXPECT_THAT(refusal<int>("10.5 us", "ms"),
              HasSubstr("expected a whole number, found '10.5 us', which is 0.0105 ms"));
}

TEST(PropertyValue, IntegersAreInTheRangeOfTheirType) {
  EXPECT_EQ(read<std::int8_t>("-128"), -128);
  EXPECT_EQ(read<std::uint64_t>("18446744073709551615"), 18446744073709551615u);
  EXPECT_EQ(read<std::int64_t>("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
  EXPECT_THAT(refusal<std::int8_t>("-129"), HasSubstr("'-129' is outside -128 .. 127"));
  EXPECT_THAT(refusal<std::uint8_t>("256"), HasSubstr("'256' is outside 0 .. 255"));
  EXPECT_THAT(refusal<unsigned>("-1"), HasSubstr("'-1' is outside 0 .. 4294967295"));
  EXPECT_THAT(refusal<std::int64_t>("9223372036854775808"), HasSubstr("is outside"));
}

TEST(PropertyValue, AFloatThatIsTooLargeIsRefused) {
  EXPECT_THAT(refusal<float>("1e39"), HasSubstr("'1e39' is too large for a float"));
}

TEST(PropertyValue, BoolsHaveTheirUsualSpellings) {
  for (const char* text : {"true", "True", "yes", "on", "1"}) EXPECT_TRUE(read<bool>(text));
  for (const char* text : {"false", "FALSE", "no", "off", "0"}) EXPECT_FALSE(read<bool>(text));
  EXPECT_THAT(refusal<bool>("maybe"), HasSubstr("expected true or false, found 'maybe'"));
}

TEST(PropertyValue, AnEnumerationHasItsNamesAndNoOthers) {
  EXPECT_EQ(read<Drive>("velocity"), Drive::kVelocity);
  EXPECT_THAT(refusal<Drive>("velocty"),
              HasSubstr("property 'P' of 'C': expected off, velocity or effort, found 'velocty' "
                        "(did you mean 'velocity'?)"));
  EXPECT_THAT(refusal<Drive>("1"), HasSubstr("expected off, velocity or effort, found '1'"));
  EXPECT_THAT(refusal<Drive>("[off]"), HasSubstr("expected off, velocity or effort, found a list"));
}

TEST(PropertyValue, TextIsTakenAsItIs) {
  EXPECT_EQ(read<std::string>("10 ms"), "10 ms");
  EXPECT_EQ(read<std::string>("\" spaces \""), " spaces ");
  EXPECT_EQ(read<base::FixedText<4>>("can0").view(), "can0");
  EXPECT_THAT(refusal<base::FixedText<4>>("canopen"),
              HasSubstr("'canopen' has 7 bytes, more than the 4 that fit"));
  EXPECT_THAT(refusal<std::string>("{a: b}"), HasSubstr("expected text, found a map"));
}

TEST(PropertyValue, ListsFillVectorsAndArraysWithAUnitForEachElement) {
  EXPECT_THAT(read<std::vector<double>>("[1 m, 20 cm, 3]", "m"), ElementsAre(1.0, 0.2, 3.0));
  EXPECT_THAT((read<std::array<int, 2>>("[1, 2]")), ElementsAre(1, 2));
  EXPECT_TRUE(read<std::vector<double>>("[]").empty());
}

TEST(PropertyValue, EveryMistakeInAListIsFoundAndNamesItsElement) {
  const std::string text = refusal<std::vector<double>>("[1 V, 2, 3 kg]", "m");
  EXPECT_THAT(text, HasSubstr("test.yaml:3:9: error: property 'P' of 'C', part '[0]': '1 V'"));
  EXPECT_THAT(text, HasSubstr("test.yaml:3:17: error: property 'P' of 'C', part '[2]': '3 kg'"));
}

TEST(PropertyValue, AnArrayHasItsOwnSize) {
  EXPECT_THAT((refusal<std::array<int, 2>>("[1, 2, 3]")),
              HasSubstr("expected 2 elements, found 3"));
  EXPECT_THAT(refusal<std::vector<double>>("1.0"),
              HasSubstr("expected a list of double, found text"));
}

TEST(PropertyValue, MapsFillStructsWhoseFieldsHaveTheirOwnUnits) {
  const auto gains = read<Gains>("{limit: 500 mV, kp: 0.5}");
  EXPECT_EQ(gains.kp, 0.5);
  EXPECT_EQ(gains.limit, 0.5);
}

TEST(PropertyValue, AStructNeedsItsFieldsAndNoOthers) {
  const std::string text = refusal<Gains>("{kq: 1, kp: 2 m}");
  EXPECT_THAT(text, HasSubstr("has no field 'kq' (did you mean 'kp'?)"));
  EXPECT_THAT(text, HasSubstr("field 'limit' is missing"));
  EXPECT_THAT(text, HasSubstr("part 'kp': '2 m': cannot convert 'm' to 'V/rad'"));
}

TEST(PropertyValue, PartsAreNamedByTheirPath) {
  EXPECT_THAT(refusal<std::vector<Gains>>("[{kp: 1, limit: 1}, {kp: x, limit: 1}]"),
              HasSubstr("part '[1].kp': "));
}

/// What goes to a file and comes back is the same.
template <typename T>
void expect_round_trip(const T& value) {
  base::Diagnostics diagnostics;
  const Value text = write_value(types::type_of<T>(), &value);
  const std::string file = orocos::write_cpf({{"P", text, "doc", {}}});
  const std::vector<Property> properties = orocos::parse_cpf(file, "test.cpf", diagnostics);
  ASSERT_EQ(properties.size(), 1u) << file;
  const auto back =
      make_value(properties[0].value, types::type_of<T>(), {}, "property 'P'", diagnostics);
  ASSERT_TRUE(back.has_value()) << diagnostics.to_text() << file;
  EXPECT_TRUE(diagnostics.empty()) << diagnostics.to_text();
  EXPECT_EQ(back->text(), types::Value::of(value).text()) << file;
}

TEST(PropertyValue, AllTypesComeBackFromAPropertyFile) {
  expect_round_trip(true);
  expect_round_trip(std::int8_t{-128});
  expect_round_trip(std::uint8_t{255});
  expect_round_trip(std::int64_t{-9007199254740993});
  expect_round_trip(std::uint64_t{18446744073709551615u});
  expect_round_trip(0.1);
  expect_round_trip(4.0);
  expect_round_trip(std::numeric_limits<double>::infinity());
  expect_round_trip(1.5f);
  expect_round_trip(std::string(" 12 & <b> {i} "));
  expect_round_trip(std::string());
  expect_round_trip(base::FixedText<8>("can0"));
}

TEST(PropertyValue, ListsAndStructsComeBackFromAPropertyFile) {
  expect_round_trip(std::vector<double>{1.0, 0.1});
  expect_round_trip(std::vector<int>{1, -2});
  expect_round_trip(std::vector<std::string>{"1", "true", ""});
  expect_round_trip(std::array<bool, 2>{true, false});
  expect_round_trip(std::vector<double>{});
  expect_round_trip(Gains{1.0, 2.5});
  expect_round_trip(std::vector<Gains>{{1.0, 2.5}, {3.0, 4.0}});
}

class Motor final : public component::Component {
 public:
  using component::Component::Component;
  component::Property<double> limit{this,          "Limit", 1.0,
                                    "upper limit", "V",     component::range(0.0, 12.0)};
  component::Property<double> sign{this, "Sign",         1.0, "-1 if it turns backwards",
                                   "",   component::sign};
};

TEST(PropertyValue, SettingAPropertyChecksItsRangeInItsUnit) {
  Motor motor("Motor");
  base::Diagnostics diagnostics;
  EXPECT_TRUE(set_property(motor.limit, written("11000 mV"), diagnostics));
  EXPECT_EQ(motor.limit(), 11.0);
  EXPECT_FALSE(set_property(motor.limit, written("24 V"), diagnostics));
  EXPECT_EQ(motor.limit(), 11.0);
  EXPECT_EQ(diagnostics.to_text(),
            "test.yaml:3:8: error: property 'Limit' of 'Motor' is 24, outside 0 .. 12 V\n");
}

TEST(PropertyValue, ASignMayBeWrittenAsABooleanOfWhichTrueInverts) {
  Motor motor("Motor");
  base::Diagnostics diagnostics;
  const std::pair<const char*, double> all[] = {
      {"true", -1.0}, {"1", 1.0}, {"-1.0", -1.0}, {"false", 1.0}, {"-1", -1.0}};
  for (const auto& [text, sign] : all) {
    EXPECT_TRUE(set_property(motor.sign, written(text), diagnostics)) << text;
    EXPECT_EQ(motor.sign(), sign) << text;
  }
  const std::string file =
      "<properties><simple name='Sign' type='boolean'><value>1</value></simple></properties>";
  const std::vector<Property> properties = orocos::parse_cpf(file, "test.cpf", diagnostics);
  motor.sign.assign(1.0);
  ASSERT_TRUE(set_property(motor.sign, properties.at(0).value, diagnostics));
  EXPECT_EQ(motor.sign(), -1.0) << "a boolean of a property file is what it says";
  EXPECT_FALSE(set_property(motor.limit, written("true"), diagnostics));
  EXPECT_FALSE(set_property(motor.sign, written("yes"), diagnostics));
}

}  // namespace
}  // namespace armature::deploy
