// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include <gtest/gtest.h>

#include "armature/testing/test_types.hpp"

namespace armature::types {
namespace {

struct alignas(128) Aligned {
  double force = 1.5;
};
ARMATURE_STRUCT(Aligned, force);

TEST(Value, StartsAsTheTypeIsConstructed) {
  const Value value(type_of<Aligned>());
  ASSERT_NE(value.get_if<Aligned>(), nullptr);
  EXPECT_EQ(value.get_if<Aligned>()->force, 1.5);
}

TEST(Value, IsAlignedAsItsType) {
  const Value value(type_of<Aligned>());
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(value.data()) % alignof(Aligned), 0u);
}

TEST(Value, CopiesItsContent) {
  Everything content = make_everything();
  const Value value = Value::of(content);
  content.text = "changed";
  EXPECT_EQ(*value.get_if<Everything>(), make_everything());
}

TEST(Value, IsIndependentOfItsCopy) {
  const Value original = Value::of(std::string("a long text that does not fit in place"));
  Value copy = original;
  static_cast<std::string*>(copy.data())->append("!");
  EXPECT_EQ(original.text(), "a long text that does not fit in place");
  EXPECT_EQ(copy.text(), "a long text that does not fit in place!");
}

TEST(Value, MovesWithoutCopying) {
  Value source = Value::of(make_everything());
  const void* const storage = source.data();
  const Value target = std::move(source);
  EXPECT_EQ(target.data(), storage);
}

TEST(Value, TakesAValueOfAnotherType) {
  Value value = Value::of(1.5);
  value = Value::of(make_everything());
  EXPECT_EQ(value.get_if<double>(), nullptr);
  EXPECT_EQ(*value.get_if<Everything>(), make_everything());
  value = Value::of(7);
  EXPECT_EQ(value.text(), "7");
}

TEST(Value, SurvivesAssignmentToItself) {
  Value value = Value::of(make_everything());
  const Value& same = value;
  value = same;
  EXPECT_EQ(*value.get_if<Everything>(), make_everything());
}

TEST(Value, GivesNothingForAnotherType) {
  EXPECT_EQ(Value::of(1.5).get_if<float>(), nullptr);
  EXPECT_EQ(Value::of(Pose{}).get_if<Everything>(), nullptr);
}

}  // namespace
}  // namespace armature::types
