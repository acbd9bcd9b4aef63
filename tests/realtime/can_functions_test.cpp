// SPDX-License-Identifier: Apache-2.0
// The real-time functions of can.
#include "armature/base/fixed_text.hpp"
#include "armature/can/frame.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::can {
namespace {

TEST(RealtimeCan, Frames) {
  const Frame frame = data_frame(0x123, {1, 2, 3, 4, 5, 6, 7, 8});
  int bits = 0;
  base::Duration time{};
  base::FixedText<32> text;
  expect_realtime("can::frame_bits", [&] { bits = frame_bits(frame); });
  expect_realtime("can::frame_time", [&] { time = frame_time(frame, 1'000'000); });
  expect_realtime("can::to_text", [&] { text = to_text(frame); });
  EXPECT_EQ(time.count(), bits * 1000);
  EXPECT_EQ(text.view(), "123#0102030405060708");
}

}  // namespace
}  // namespace armature::can
