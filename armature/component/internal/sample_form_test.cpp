// SPDX-License-Identifier: Apache-2.0
// Samples of types that are known by their descriptions only.
#include "armature/component/internal/sample_form.hpp"

#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "armature/types/struct.hpp"

namespace armature::component::internal {
namespace {

struct Pair {
  std::int8_t small;
  double large;
};
ARMATURE_STRUCT(Pair, small, large);

struct alignas(32) Wide {
  double value;
};
ARMATURE_STRUCT(Wide, value);

template <typename T>
class SampleForms : public testing::Test {};
using Types = testing::Types<bool, std::int16_t, int, double, std::array<std::int8_t, 9>, Pair,
                             Wide, std::vector<double>>;
TYPED_TEST_SUITE(SampleForms, Types);

TYPED_TEST(SampleForms, FindEachPartWhereTheCompilerPutIt) {
  Sample<TypeParam> sample{TypeParam{}, base::Time(base::Duration(7)), 11};
  const SampleForm form(types::type_of<TypeParam>());
  EXPECT_EQ(form.size(), sizeof sample);
  EXPECT_EQ(form.alignment(), alignof(Sample<TypeParam>));
  EXPECT_EQ(form.time(&std::as_const(sample)), sample.time);
  EXPECT_EQ(form.sequence(&std::as_const(sample)), 11u);
  form.sequence(&sample) = 12;
  EXPECT_EQ(sample.sequence, 12u);
}

TYPED_TEST(SampleForms, AreCarriedInTheirOwnSizeIfSmall) {
  const SampleForm form(types::type_of<TypeParam>());
  const auto size = with_sample_of<std::size_t>(
      form, is_small<TypeParam>,
      []<typename S>() -> std::size_t { return std::is_same_v<S, AnySample> ? 0 : sizeof(S); });
  EXPECT_EQ(size, is_small<TypeParam> ? sizeof(Sample<TypeParam>) : 0);
}

using Numbers = std::vector<double>;

struct AnySamples : testing::Test {
  const Numbers& value(const AnySample& sample) {
    return static_cast<const Sample<Numbers>*>(sample.get())->value;
  }
  const SampleForm form{types::type_of<Numbers>()};
  Sample<Numbers> written{{1.0, 2.0}, base::Time(base::Duration(5)), 3};
};

TEST_F(AnySamples, BeginWithTheDefaultValueNeverWritten) {
  const AnySample sample(form);
  EXPECT_TRUE(value(sample).empty());
  EXPECT_EQ(form.sequence(sample.get()), 0u);
}

TEST_F(AnySamples, ThatAreViewsLookAtWhatTheyWereMadeOf) {
  EXPECT_EQ(AnySample::view(form, &written).get(), &written);
}

TEST_F(AnySamples, ThatKeepAViewHoldACopyOfAllOfIt) {
  AnySample kept(form);
  kept = AnySample::view(form, &written);
  written.value = {9.0};
  EXPECT_NE(kept.get(), &written);
  EXPECT_EQ(value(kept), (Numbers{1.0, 2.0}));
  EXPECT_EQ(form.time(std::as_const(kept).get()), written.time);
  EXPECT_EQ(form.sequence(std::as_const(kept).get()), 3u);
}

TEST_F(AnySamples, TradePlacesWithoutACopy) {
  AnySample first = AnySample::of_value(form, &written.value);
  AnySample second(form);
  const void* const storage = first.get();
  std::swap(first, second);
  EXPECT_EQ(second.get(), storage);
  EXPECT_TRUE(value(first).empty());
  EXPECT_EQ(value(second), written.value);
}

}  // namespace
}  // namespace armature::component::internal
