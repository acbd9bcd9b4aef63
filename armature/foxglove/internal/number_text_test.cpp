// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/internal/number_text.hpp"

#include <array>
#include <limits>

#include <gtest/gtest.h>

namespace armature::foxglove::internal {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(NumberText, ANumberIsTheMemberValue) {
  const NumberText text(shape_of("double", {}), {""});
  EXPECT_EQ(text.filled(std::array{0.5}), R"({"value":0.5})");
  EXPECT_EQ(text.filled(std::array{kNan}), R"({"value":null})");
  EXPECT_EQ(text.filled(std::array{-kInfinity}), R"({"value":-1e999})");
}

TEST(NumberText, AListHasItsNumbersInOrder) {
  const NumberText text(shape_of("vector<double>", {}), {"[1]", "[2]", "[3]"});
  EXPECT_EQ(text.filled(std::array{1.0, -2.25, 3.0}), R"({"value":[1,-2.25,3]})");
}

TEST(NumberText, AStructIsItselfAndItsBooleansAreNoNumbers) {
  const std::vector<inspect::FieldDescription> fields{
      {"Pose", "x", "double", "m", "ahead", {}},
      {"Pose", "arm", "Arm", "", "", {}},
      {"Arm", "q", "array<double,2>", "rad", "", {}},
      {"Arm", "braked", "bool", "", "", {}}};
  const NumberText text(shape_of("Pose", fields), {".x", ".arm.q[1]", ".arm.q[2]", ".arm.braked"});
  EXPECT_EQ(text.filled(std::array{1.5, 2.0, 3.0, 1.0}),
            R"({"x":1.5,"arm":{"q":[2,3],"braked":true}})");
}

}  // namespace
}  // namespace armature::foxglove::internal
