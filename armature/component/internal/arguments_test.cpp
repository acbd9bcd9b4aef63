// SPDX-License-Identifier: Apache-2.0
// Arguments on their way to another thread.
#include "armature/component/internal/arguments.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace armature::component::internal {
namespace {

template <typename T>
const T& argument(const Arguments& arguments, std::size_t index) {
  return *static_cast<const T*>(arguments.places()[index]);
}

TEST(Arguments, HoldCopiesInTheOrderOfTheSignature) {
  Arguments arguments(Signature::of<void, int, const std::vector<double>&, std::string>({}));
  int number = 3;
  std::vector<double> vector{1.0, 2.0};
  std::string text = "there";
  const void* const places[] = {&number, &vector, &text};
  arguments.assign(places);
  number = 4;
  vector.clear();
  text.clear();
  EXPECT_EQ(argument<int>(arguments, 0), 3);
  EXPECT_EQ(argument<std::vector<double>>(arguments, 1), (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(argument<std::string>(arguments, 2), "there");
}

TEST(Arguments, StayWhereTheyAreWhenTheyAreMoved) {
  Arguments made(Signature::of<void, double>({}));
  const double value = 0.5;
  const void* const places[] = {&value};
  made.assign(places);
  const Arguments kept = std::move(made);
  EXPECT_EQ(argument<double>(kept, 0), 0.5);
}

TEST(Arguments, HaveAPlaceForTheResultOfTheSignatureAlone) {
  const Arguments none(Signature::of<void, double>({}));
  EXPECT_EQ(none.result(), nullptr);
  const Arguments alone(Signature::of<std::string>({}));
  *static_cast<std::string*>(alone.result()) = "longer than what a text keeps within itself";
  EXPECT_EQ(*static_cast<std::string*>(alone.result()),
            "longer than what a text keeps within itself");
}

TEST(Arguments, AreAlignedAsTheirTypesAreWhateverStandsBeforeThem) {
  Arguments arguments(Signature::of<double, bool, double, std::int8_t, std::vector<double>>({}));
  const bool yes = true;
  const double value = 2.5;
  const std::int8_t small = -3;
  const std::vector<double> vector{1.0};
  const void* const places[] = {&yes, &value, &small, &vector};
  arguments.assign(places);
  EXPECT_TRUE(argument<bool>(arguments, 0));
  EXPECT_EQ(argument<double>(arguments, 1), 2.5);
  EXPECT_EQ(argument<std::int8_t>(arguments, 2), -3);
  EXPECT_EQ(argument<std::vector<double>>(arguments, 3), vector);
  const auto is_aligned = [](const void* at, std::size_t to) {
    return reinterpret_cast<std::uintptr_t>(at) % to == 0;
  };
  EXPECT_TRUE(is_aligned(arguments.places()[1], alignof(double)));
  EXPECT_TRUE(is_aligned(arguments.places()[3], alignof(std::vector<double>)));
  EXPECT_TRUE(is_aligned(arguments.result(), alignof(double)));
}

TEST(Arguments, TakeTheValuesOfThoseThatAreAssignedToThem) {
  Arguments kept;
  Arguments made(Signature::of<void, std::string>({}));
  const std::string text = "longer than what a text keeps within itself";
  const void* const places[] = {&text};
  made.assign(places);
  kept = std::move(made);
  EXPECT_EQ(argument<std::string>(kept, 0), text);
}

}  // namespace
}  // namespace armature::component::internal
