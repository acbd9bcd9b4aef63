// SPDX-License-Identifier: Apache-2.0
// What rcidl generates, and what that calls of ride.
#include <array>
#include <cstdint>
#include <vector>

#include "armature/ride/range.hpp"
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

}  // namespace
}  // namespace armature::ride
