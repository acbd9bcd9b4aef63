// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/operators_bench.hpp"

#include "armature/base/seconds.hpp"
#include "armature/platform/clock.hpp"

namespace armature::studio::internal {

void OperatorsBench::emergency_stop(ride::ReplyOf<EmergencyStop> reply) {
  const auto owed = std::make_shared<ride::PendingReplyOf<EmergencyStop>>(reply.keep());
  stops_.press(platform::monotonic_now(), [owed](const auto& outcome) {
    if (outcome) {
      owed->put({outcome.value().disarmed, outcome.value().stopped});
    } else {
      owed->fail(outcome.error());
    }
  });
}

void OperatorsBench::seat(ride::ReplyOf<SeatState> reply) { reply.put(seat_state(reply)); }

void OperatorsBench::take_seat(ride::ReplyOf<SeatState> reply) {
  seat_state(reply);  // from now on who asks is known
  seated(seat_.take(reply.origin()), reply);
}

void OperatorsBench::hand_over(std::int32_t guest, ride::ReplyOf<SeatState> reply) {
  seated(seat_.hand_over(reply.origin(), guest), reply);
}

void OperatorsBench::leave_seat(ride::ReplyOf<SeatState> reply) {
  seated(seat_.leave(reply.origin()), reply);
}

void OperatorsBench::hold_key(bool down, ride::ReplyOf<double> reply) {
  const auto held = seat_.hold_key(reply.origin(), down, platform::monotonic_now());
  if (!held) throw ride::Failure(held.error());
  reply.put(base::to_seconds(held.value()));
}

SeatState OperatorsBench::seat_state(const ride::ReplyOf<SeatState>& reply) {
  const bool may_operate = reply.allows(kName, ride::Access::kCommand);
  const Seat::State state = seat_.state(reply.origin(), may_operate);
  SeatState told{state.you, state.holder, {}};
  for (const auto& [number, who, may] : state.guests) told.guests.push_back({number, who, may});
  return told;
}

void OperatorsBench::seated(const base::Result<void>& result, ride::ReplyOf<SeatState>& reply) {
  if (!result) throw ride::Failure(result.error());
  wake_();
  reply.put(seat_state(reply));
}

}  // namespace armature::studio::internal
