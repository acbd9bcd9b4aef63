// SPDX-License-Identifier: Apache-2.0
#include "armature/types/number_place.hpp"

#include <array>
#include <cmath>
#include <cstdint>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/types/enum.hpp"
#include "armature/types/struct.hpp"

namespace armature::types {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

enum class Mode : std::uint8_t { kIdle = 0, kMoving = 7 };
ARMATURE_ENUM(Mode, kIdle, kMoving);

struct Gains {
  double kp = 0.0;
  float ki = 0.0F;
};
ARMATURE_STRUCT(Gains, kp, ki);

struct Arm {
  bool on = false;
  std::string name;
  std::vector<Gains> gains;
  std::array<std::int16_t, 2> counts{};
  Mode mode = Mode::kIdle;
};
ARMATURE_STRUCT(Arm, on, name, gains, counts, mode);

template <typename T>
std::vector<NumberPlace> places_in(const T& value) {
  return NumberPlace::all_in(type_of<T>(), &value);
}

template <typename T>
std::vector<double> numbers_in(const T& value) {
  std::vector<double> numbers;
  for (const NumberPlace& place : places_in(value)) numbers.push_back(place.read(&value));
  return numbers;
}

template <typename T>
std::vector<std::string> paths_in(const T& value) {
  std::vector<std::string> paths;
  for (const NumberPlace& place : places_in(value)) paths.push_back(place.path());
  return paths;
}

TEST(NumberPlace, AScalarIsOneNumber) {
  EXPECT_THAT(numbers_in(0.25), ElementsAre(0.25));
  EXPECT_THAT(numbers_in(true), ElementsAre(1.0));
  EXPECT_THAT(numbers_in(std::int64_t{-5}), ElementsAre(-5.0));
  EXPECT_THAT(numbers_in(Mode::kMoving), ElementsAre(7.0));
  EXPECT_THAT(paths_in(0.25), ElementsAre(""));
}

TEST(NumberPlace, TextsHaveNone) { EXPECT_THAT(numbers_in(std::string("3")), IsEmpty()); }

TEST(NumberPlace, FindsAllNumbersOfStructsAndLists) {
  Arm arm{true, "left", {{1.0, 2.0F}, {3.0, 4.0F}}, {-1, 9}, Mode::kMoving};
  EXPECT_THAT(numbers_in(arm), ElementsAre(1.0, 1.0, 2.0, 3.0, 4.0, -1.0, 9.0, 7.0));
  EXPECT_THAT(paths_in(arm), ElementsAre(".on", ".gains[1].kp", ".gains[1].ki", ".gains[2].kp",
                                         ".gains[2].ki", ".counts[1]", ".counts[2]", ".mode"));
}

TEST(NumberPlace, StaysWhereItIsWhenAVectorMovesOrShrinks) {
  Arm arm{true, "", {{1.0, 2.0F}, {3.0, 4.0F}}, {}, Mode::kIdle};
  const NumberPlace place = places_in(arm).at(3);
  ASSERT_EQ(place.path(), ".gains[2].kp");
  arm.gains.reserve(1000);
  arm.gains[1].kp = 5.0;
  EXPECT_EQ(place.read(&arm), 5.0);
  arm.gains.resize(1);
  EXPECT_TRUE(std::isnan(place.read(&arm)));
}

TEST(NumberPlace, VectorsOfVectorsAreWalkedThrough) {
  const std::vector<std::vector<double>> rows{{1.0}, {}, {2.0, 3.0}};
  EXPECT_THAT(numbers_in(rows), ElementsAre(1.0, 2.0, 3.0));
  EXPECT_THAT(paths_in(rows), ElementsAre("[1][1]", "[3][1]", "[3][2]"));
}

}  // namespace
}  // namespace armature::types
