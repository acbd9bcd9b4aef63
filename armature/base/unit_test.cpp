// SPDX-License-Identifier: Apache-2.0
#include "armature/base/unit.hpp"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace armature::base {
namespace {

constexpr double kPi = std::numbers::pi;

struct Conversion {
  double value;
  const char* from;
  const char* to;
  double expected;
};

std::ostream& operator<<(std::ostream& out, const Conversion& one) {
  return out << one.value << " " << one.from << " in " << one.to;
}

class UnitConversion : public testing::TestWithParam<Conversion> {};

TEST_P(UnitConversion, GivesTheExactDouble) {
  const auto [value, from, to, expected] = GetParam();
  const Result<double> result = convert(value, from, to);
  ASSERT_TRUE(result) << result.error();
  EXPECT_EQ(result.value(), expected);
}

INSTANTIATE_TEST_SUITE_P(
    Time, UnitConversion,
    testing::Values(Conversion{10, "ms", "s", 0.01}, Conversion{7, "us", "s", 7e-6},
                    Conversion{3, "ns", "s", 3e-9}, Conversion{1, "s", "ns", 1e9},
                    Conversion{0.1, "ms", "us", 100}, Conversion{2, "min", "s", 120},
                    Conversion{1.5, "h", "min", 90}, Conversion{1, "kHz", "Hz", 1000},
                    Conversion{50, "1/s", "Hz", 50}, Conversion{120, "1/min", "Hz", 2},
                    Conversion{4, "s^-1", "Hz", 4}, Conversion{4, "s⁻¹", "Hz", 4},
                    Conversion{5, "\u00b5s", "ns", 5000}, Conversion{5, "\u03bcs", "ns", 5000}));

INSTANTIATE_TEST_SUITE_P(
    LengthAndMass, UnitConversion,
    testing::Values(Conversion{3, "mm", "m", 0.003}, Conversion{25, "cm", "mm", 250},
                    Conversion{1, "um", "m", 1e-6}, Conversion{2, "km", "m", 2000},
                    Conversion{250, "g", "kg", 0.25}, Conversion{1, "kg", "g", 1000},
                    Conversion{5, "mm^2", "m^2", 5e-6}, Conversion{1, "m²", "cm^2", 10000},
                    Conversion{1, "m³", "cm^3", 1e6}, Conversion{2, "m/s/s", "m/s^2", 2},
                    Conversion{2, "m s^-2", "m/s²", 2}));

INSTANTIATE_TEST_SUITE_P(
    Angle, UnitConversion,
    testing::Values(Conversion{180, "deg", "rad", kPi}, Conversion{90, "deg", "rev", 0.25},
                    Conversion{1, "turn", "deg", 360}, Conversion{1, "rev", "rad", 2 * kPi},
                    Conversion{5, "mrad", "rad", 0.005}, Conversion{1, "rpm", "deg/s", 6},
                    Conversion{60, "rpm", "rad/s", 2 * kPi}, Conversion{60, "rpm", "rev/s", 1},
                    Conversion{180, "deg/s^2", "rad/s^2", kPi}));

INSTANTIATE_TEST_SUITE_P(
    Mechanics, UnitConversion,
    testing::Values(Conversion{2, "kN", "N", 2000}, Conversion{2, "N m", "Nm", 2},
                    Conversion{2, "N*m", "Nm", 2}, Conversion{2, "N·m", "Nm", 2},
                    Conversion{5, "Nmm", "Nm", 0.005}, Conversion{5, "mNm", "Nmm", 5},
                    Conversion{2, "Nm", "J", 2}, Conversion{2, "kg m^2/s^2", "N m", 2},
                    Conversion{2, "kg*m/s^2", "N", 2}, Conversion{3, "N m/rad", "Nm/rad", 3},
                    Conversion{3, "N mm/A", "N m/A", 0.003}, Conversion{2, "J/s", "W", 2}));

INSTANTIATE_TEST_SUITE_P(
    ElectricityAndRest, UnitConversion,
    testing::Values(Conversion{24, "V", "mV", 24000}, Conversion{1500, "mA", "A", 1.5},
                    Conversion{3, "V A", "W", 3}, Conversion{3, "V/A", "Ohm", 3},
                    Conversion{3, "kOhm", "Ω", 3000}, Conversion{3, "V s/A", "H", 3},
                    Conversion{3, "mH", "uH", 3000}, Conversion{3, "A s/V", "F", 3},
                    Conversion{47, "pF", "nF", 0.047}, Conversion{2, "V/(rad/s)", "V s/rad", 2},
                    Conversion{2, "V/rad", "mV/rad", 2000}, Conversion{4, "counts", "count", 4},
                    Conversion{4, "pulse/rev", "count/rev", 4},
                    Conversion{2, "m/(s px)", "mm/s/px", 2000},
                    Conversion{1, "Mbit/s", "kbit/s", 1000}, Conversion{300, "K", "K", 300},
                    Conversion{50, "%", "", 0.5}, Conversion{0.5, "1", "%", 50},
                    Conversion{0.3, " ", "", 0.3}));

TEST(Unit, OfAnEncoderDividesCountsByAngle) {
  const Result<Unit> unit = parse_unit("count/rev");
  ASSERT_TRUE(unit);
  Unit expected;
  expected.powers[Unit::kCount] = 1;
  expected.powers[Unit::kAngle] = -1;
  EXPECT_TRUE(unit.value().same_kind(expected));
  EXPECT_DOUBLE_EQ(unit.value().factor, 1 / (2 * kPi));
}

TEST(Unit, KeepsDifferentKindsApart) {
  const auto same_kind = [](std::string_view a, std::string_view b) {
    return parse_unit(a).value().same_kind(parse_unit(b).value());
  };
  EXPECT_FALSE(same_kind("rad/s", "Hz"));
  EXPECT_FALSE(same_kind("N m", "N m/rad"));
  EXPECT_FALSE(same_kind("rad", "1"));
  EXPECT_FALSE(same_kind("count", "1"));
  EXPECT_FALSE(same_kind("count/s", "Hz"));
  EXPECT_FALSE(same_kind("m", "mm^2"));
  EXPECT_FALSE(same_kind("H", "h"));
}

TEST(Unit, IsTheSameIfANumberInItIs) {
  const auto same = [](std::string_view a, std::string_view b) {
    return parse_unit(a).value().same_as(parse_unit(b).value());
  };
  EXPECT_TRUE(same("N m", "kg m^2/s^2"));
  EXPECT_FALSE(same("m", "mm"));
  EXPECT_FALSE(same("rad/s", "Hz"));
}

TEST(Units, OfSeveralThatAValueMayBeInTheOneOfItsKindCounts) {
  EXPECT_EQ(convert(500, "mm/s", "rad/s or m/s").value(), 0.5);
  EXPECT_EQ(convert(2, "rad/s", "rad/s or m/s").value(), 2);
  EXPECT_FALSE(convert(2, "V", "rad/s or m/s"));
}

TEST(Unit, IgnoresSpaceAroundItsParts) {
  EXPECT_EQ(convert(1, "  N  m / rad ", "Nm/rad").value(), 1);
  EXPECT_EQ(convert(1, "V / ( rad / s )", "V/(rad/s)").value(), 1);
}

struct Mistake {
  const char* unit;
  const char* error;
};

class UnitMistake : public testing::TestWithParam<Mistake> {};

TEST_P(UnitMistake, IsNamedWithAHint) {
  const Result<Unit> result = parse_unit(GetParam().unit);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error(), GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(
    Unit, UnitMistake,
    testing::Values(
        Mistake{"radd/s", "unknown unit 'radd' in 'radd/s' (did you mean 'rad'?)"},
        Mistake{"sec", "unknown unit 'sec' (did you mean 's'?)"},
        Mistake{"degrees/s", "unknown unit 'degrees' in 'degrees/s' (did you mean 'deg'?)"},
        Mistake{"khz", "unknown unit 'khz' (did you mean 'kHz'?)"},
        Mistake{"m/s2", "unknown unit 's2' in 'm/s2' (did you mean 's^2'?)"},
        Mistake{"degC", "unknown unit 'degC' (a temperature is given in K)"},
        Mistake{"furlong", "unknown unit 'furlong'"},
        Mistake{"mmin", "unknown unit 'mmin' (did you mean 'min'?)"},
        Mistake{"/s", "expected a unit, found '/s' in unit '/s'"},
        Mistake{"m/", "expected a unit, found nothing in unit 'm/'"},
        Mistake{"m**2", "expected a unit, found '*2' in unit 'm**2'"},
        Mistake{"m^",
                "expected a power from 1 to 9 or -1 to -9 after '^', found nothing in unit "
                "'m^'"},
        Mistake{"m^0",
                "expected a power from 1 to 9 or -1 to -9 after '^', found '0' in unit "
                "'m^0'"},
        Mistake{"m^10",
                "expected a power from 1 to 9 or -1 to -9 after '^', found '10' in unit "
                "'m^10'"},
        Mistake{"m^2s", "unexpected 's' in unit 'm^2s'"},
        Mistake{"V/(rad/s", "unit 'V/(rad/s' lacks a ')'"},
        Mistake{"m)", "unexpected ')' in unit 'm)'"},
        Mistake{"V/rad s",
                "unit 'V/rad s' is ambiguous: a product after '/' needs parentheses, as in "
                "'V/(rad s)'"},
        Mistake{"Gm^9 Gm^9 Gm^9 Gm^9", "unit 'Gm^9 Gm^9 Gm^9 Gm^9' is too large or too small"}));

TEST(Unit, RefusesVeryLongText) {
  const Result<Unit> result = parse_unit(std::string(100'000, '('));
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().find("is longer than 64 bytes"), std::string::npos);
  EXPECT_LT(result.error().size(), 200u);
}

TEST(Convert, NamesBothUnitsOfDifferentKinds) {
  EXPECT_EQ(convert(1, "deg", "m").error(),
            "cannot convert 'deg' to 'm': the first is rad, the second m");
  EXPECT_EQ(convert(1, "N m", "N m/rad").error(),
            "cannot convert 'N m' to 'N m/rad': the first is m^2 kg s^-2, the second "
            "m^2 kg s^-2 rad^-1");
  EXPECT_EQ(convert(1, "", "s").error(),
            "cannot convert '' to 's': the first is a plain number, the second s");
}

TEST(Convert, NamesTheUnknownUnit) {
  EXPECT_EQ(convert(1, "foot", "m").error(), "unknown unit 'foot'");
  EXPECT_EQ(convert(1, "m", "foot").error(), "unknown unit 'foot'");
}

TEST(Convert, RefusesAResultThatIsNotFinite) {
  EXPECT_EQ(convert(1e308, "km", "mm").error(), "a value in 'km' is not a finite number in 'mm'");
  EXPECT_FALSE(convert(std::numeric_limits<double>::quiet_NaN(), "m", "m"));
}

TEST(Convert, IsRightToTheLastDigitsIfTheFactorHasNoExactDouble) {
  EXPECT_DOUBLE_EQ(convert(36, "km/h", "m/s").value(), 10);
  EXPECT_DOUBLE_EQ(convert(1, "rad", "deg").value(), 180 / kPi);
}

TEST(Convert, KeepsSignAndZero) {
  EXPECT_EQ(convert(-45, "deg", "rev").value(), -0.125);
  EXPECT_EQ(convert(0, "km", "mm").value(), 0.0);
}

void expect_quantity(std::string_view text, double value, std::string_view unit) {
  const Result<Quantity> quantity = parse_quantity(text);
  ASSERT_TRUE(quantity) << quantity.error();
  EXPECT_EQ(quantity.value().value, value) << text;
  EXPECT_EQ(quantity.value().unit, unit) << text;
}

TEST(Quantity, IsANumberWithItsUnitAsWritten) {
  expect_quantity("10 ms", 10, "ms");
  expect_quantity("10ms", 10, "ms");
  expect_quantity("-4.5e-3 rad", -0.0045, "rad");
  expect_quantity("  2.5  N m / rad ", 2.5, "N m / rad");
  expect_quantity("50%", 50, "%");
  expect_quantity("3e2", 300, "");
  expect_quantity("5", 5, "");
  expect_quantity("0.1", 0.1, "");
}

TEST(Quantity, RefusesWhatIsNoFiniteNumber) {
  for (const char* text : {"", " ", "ms", "nan", "inf", "-inf s", "infinity", "nan(1)", "- 5"}) {
    const Result<Quantity> quantity = parse_quantity(text);
    ASSERT_FALSE(quantity) << text;
    EXPECT_NE(quantity.error().find("expected a finite number"), std::string::npos);
  }
}

TEST(Quantity, RefusesANumberBeyondADouble) {
  EXPECT_EQ(parse_quantity("1e999 m").error(),
            "number '1e999 m' is too large or too small for a double");
  EXPECT_EQ(parse_quantity("1e-999").error(),
            "number '1e-999' is too large or too small for a double");
}

TEST(Quantity, NamesItsUnknownUnit) {
  EXPECT_EQ(parse_quantity("10 mss").error(), "'10 mss': unknown unit 'mss' (did you mean 'ms'?)");
  EXPECT_EQ(parse_quantity("10 20").error(), "'10 20': unknown unit '20'");
  EXPECT_EQ(parse_quantity("0,5").error(), "'0,5' has a decimal comma; write a point: '0.5'");
  EXPECT_EQ(parse_quantity("1.2.3").error(), "'1.2.3': unknown unit '.3'");
}

}  // namespace
}  // namespace armature::base
