// SPDX-License-Identifier: Apache-2.0
// Arguments on their way to another thread.
#include "armature/component/internal/arguments.hpp"

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

}  // namespace
}  // namespace armature::component::internal
