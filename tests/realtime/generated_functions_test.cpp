// SPDX-License-Identifier: Apache-2.0
// What rcidl generates, and what that calls of ride.
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "armature/ride/range.hpp"
#include "armature/types/enum.hpp"
#include "everything_types.hpp"
#include "geometry_types.hpp"
#include "tests/realtime/expect_realtime.hpp"
#include "vision_types.hpp"

namespace armature::ride {
namespace {

TEST(RealtimeGenerated, Ranges) {
  const std::vector<std::int32_t> list{1, 2, 3};
  const std::array<std::int32_t, 2> fixed{1, 9};
  const std::vector<everything::Later> structs{{1}, {0}};
  bool all = false;
  expect_realtime("ride::within", [&] {
    all = within(0.5, 0.0, 1.0) && within(list, 1, 3) && within(fixed, 1, 9);
  });
  EXPECT_TRUE(all);
  expect_realtime("ride::all_in_range", [&] { all = all_in_range(structs); });
  EXPECT_TRUE(all);
}

TEST(RealtimeGenerated, StructsOfFixedSize) {
  Body body;
  body.reserve(256);
  const geometry::Pose pose{1.0, 2.0, 0.5};
  geometry::Pose taken;
  vision::ObjectPosition position;
  bool all = false;
  expect_realtime("generated encode and decode", [&] {
    body.clear();
    Encoder to(body);
    to.put(pose);
    to.put(vision::ObjectPosition{320, 240});
    Decoder from(body.bytes());
    all = from.take(taken) && from.take(position) && from.ended();
  });
  EXPECT_TRUE(all);
  EXPECT_EQ(taken.heading, 0.5);
  EXPECT_EQ(position.x, 320);
}

TEST(RealtimeGenerated, Enumerations) {
  Body body;
  body.reserve(64);
  everything::Mode taken = everything::Mode::kIdle;
  types::type_of<everything::Mode>();  // described once
  bool ok = false;
  expect_realtime("generated encode and decode of an enum", [&] {
    body.clear();
    Encoder to(body);
    to.put(everything::Mode::kHoldPosition);
    Decoder from(body.bytes());
    ok = from.take(taken) && from.ended();
  });
  EXPECT_TRUE(ok);
  EXPECT_EQ(taken, everything::Mode::kHoldPosition);
}

TEST(RealtimeGenerated, NamesOfEnumerators) {
  const types::Type& type = types::type_of<everything::Mode>();
  const types::Enumerator* const hold = types::find_enumerator(type, "hold_position");
  ASSERT_NE(hold, nullptr);
  everything::Mode value = everything::Mode::kIdle;
  std::string_view name;
  expect_realtime("types::set_enumerator", [&] { types::set_enumerator(type, *hold, &value); });
  EXPECT_EQ(value, everything::Mode::kHoldPosition);
  expect_realtime("types::enumerator_name", [&] { name = types::enumerator_name(type, &value); });
  EXPECT_EQ(name, "hold_position");
  expect_realtime("types::name_of", [&] { name = types::name_of(everything::Mode::kPosition); });
  EXPECT_EQ(name, "position");
  const auto unknown = static_cast<everything::Mode>(3);
  bool is_known = true;
  expect_realtime("types::is_enumerator", [&] { is_known = types::is_enumerator(type, &unknown); });
  EXPECT_FALSE(is_known);
}

}  // namespace
}  // namespace armature::ride
