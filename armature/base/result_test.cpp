// SPDX-License-Identifier: Apache-2.0
#include "armature/base/result.hpp"

#include <memory>

#include <gtest/gtest.h>

namespace armature::base {
namespace {

Result<int> half(int number) {
  if (number % 2 != 0) return Error{"odd"};
  return number / 2;
}

TEST(Result, HoldsAValue) {
  const Result<int> result = half(4);
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(result);
  EXPECT_EQ(result.value(), 2);
}

TEST(Result, HoldsTheReasonWhyThereIsNoValue) {
  const Result<int> result = half(3);
  ASSERT_FALSE(result.ok());
  EXPECT_FALSE(result);
  EXPECT_EQ(result.error(), "odd");
}

TEST(Result, GivesItsValueAway) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(7);
  const std::unique_ptr<int> owned = std::move(result).value();
  EXPECT_EQ(*owned, 7);
}

TEST(Result, HoldsATextApartFromAnError) {
  EXPECT_TRUE(Result<std::string>(std::string("fine")).ok());
  EXPECT_FALSE(Result<std::string>(Error{"fine"}).ok());
}

TEST(Result, OfVoidIsDoneOrAnError) {
  EXPECT_TRUE(Result<void>().ok());
  const Result<void> failed = Error{"no disk"};
  EXPECT_FALSE(failed);
  EXPECT_EQ(failed.error(), "no disk");
}

TEST(Result, OfVoidWithAnEmptyReasonIsStillAnError) { EXPECT_FALSE(Result<void>(Error{}).ok()); }

}  // namespace
}  // namespace armature::base
