// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/wam_guard.hpp"

#include "robots/wam/protocol/puck_protocol.hpp"

namespace armature::wam {

guardian::Orders guard_orders(const WamRecord& arm, const std::string& bus, base::Duration period) {
  constexpr int kIdle = static_cast<int>(PuckMode::kIdle);
  constexpr std::uint32_t kAnyNode = 0x41f;  // the mask: to the host, from whomever
  guardian::Orders orders;
  orders.bus = bus;
  orders.bit_rate = kBitRate;
  orders.period = period;
  orders.safe = {set_frame(to_group(Group::kLowerArm), arm.motor_mode_number, kIdle),
                 set_frame(to_group(Group::kArm), arm.motor_mode_number, kIdle)};
  orders.questions = {get_frame(to_group(Group::kLowerArm), arm.motor_mode_number)};
  if (arm.motors > kTorquesPerFrame) {
    orders.safe.push_back(set_frame(to_group(Group::kWrist), arm.motor_mode_number, kIdle));
    orders.questions.push_back(get_frame(to_group(Group::kWrist), arm.motor_mode_number));
  }
  for (std::size_t motor = 0; motor < arm.motors; ++motor) {
    // Pucks answer with two bytes of value or with four; the lower two say it.
    orders.answers.push_back(
        {.device = motor,
         .frame = reply_frame(arm.pucks[motor].node, arm.motor_mode_number, kIdle, Width::kFour),
         .mask = {0xff, 0xff, 0xff, 0xff}});
  }
  orders.answers_filter = {.id = identifier(to_group(Group::kReplies)), .mask = kAnyNode};
  return orders;
}

}  // namespace armature::wam
