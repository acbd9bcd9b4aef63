// SPDX-License-Identifier: Apache-2.0
#include "armature/generate/internal/literal.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/generate/internal/code.hpp"
#include "armature/types/enum.hpp"

namespace armature::generate::internal {

enum class Colour : std::uint8_t { kRed, kGreen };
ARMATURE_ENUM(Colour, kRed, kGreen);

namespace {

using namespace std::chrono_literals;

template <typename T>
std::optional<std::string> literal_of(const T& value) {
  return literal(types::type_of<T>(), &value);
}

TEST(Literal, IsOfExactlyItsType) {
  EXPECT_EQ(literal_of(true), "true");
  EXPECT_EQ(literal_of(400.0), "400.0");
  EXPECT_EQ(literal_of(0.1), "0.1");
  EXPECT_EQ(literal_of(1e-05), "1e-05");
  EXPECT_EQ(literal_of(-0.0), "-0.0");
  EXPECT_EQ(literal_of(0.5f), "0.5f");
  EXPECT_EQ(literal_of(-3), "-3");
  EXPECT_EQ(literal_of(std::uint8_t{200}), "std::uint8_t{200}");
  EXPECT_EQ(literal_of(std::int64_t{-7}), "std::int64_t{-7}");
  EXPECT_EQ(literal_of(std::numeric_limits<std::uint64_t>::max()),
            "std::uint64_t{18446744073709551615u}");
  EXPECT_EQ(literal_of(std::string("a \"b\"\\\n\x01")), R"("a \"b\"\\\n\001")");
  EXPECT_EQ(literal_of(std::vector<double>{1.0, 2.5}), "std::vector<double>{1.0, 2.5}");
  EXPECT_EQ(literal_of(std::vector<std::string>{"x", "y"}),
            R"(std::vector<std::string>{"x", "y"})");
  EXPECT_EQ(literal_of(std::array<int, 2>{4, 5}), "std::array<int, 2>{4, 5}");
  EXPECT_EQ(literal_of(std::vector<double>{}), "std::vector<double>{}");
}

TEST(Literal, OfAValueThatNoLiteralHasIsNothing) {
  EXPECT_EQ(literal_of(std::numeric_limits<double>::infinity()), std::nullopt);
  EXPECT_EQ(literal_of(std::vector<double>{1.0, std::numeric_limits<double>::quiet_NaN()}),
            std::nullopt);
  EXPECT_EQ(literal_of(std::numeric_limits<int>::min()), std::nullopt);
  EXPECT_EQ(literal_of(Colour::kGreen), std::nullopt);
}

TEST(Literal, OfATextKeepsItsNulCharacters) {
  EXPECT_EQ(text_literal(std::string_view("a\0"
                                          "1",
                                          3)),
            R"(std::string("a\0001", 3))");
}

TEST(Literal, OfADurationIsExact) {
  EXPECT_EQ(duration_literal(10ms), "10ms");
  EXPECT_EQ(duration_literal(2000ms), "2s");
  EXPECT_EQ(duration_literal(1500us), "1500us");
  EXPECT_EQ(duration_literal(7ns), "7ns");
}

TEST(Code, BreaksLongLinesBehindItemsAndNeverWithinATextInQuotes) {
  Code code;
  const std::string item = '"' + std::string(40, 'a') + ", {b\"";
  code.chain({"to.f()", ".set({" + item + ", " + item + ", " + item + "})"});
  EXPECT_EQ(code.text(), "  to.f()\n      .set({" + item + ",\n          " + item +
                             ",\n          " + item + "});\n");
}

}  // namespace
}  // namespace armature::generate::internal
