// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

#include "armature/remote/control_queue.hpp"
#include "armature/studio/internal/emergency_stop.hpp"
#include "armature/studio/internal/seat.hpp"
#include "workbench_service.hpp"

namespace armature::studio::internal {

/// What pages ask of every workbench: who may begin a motion, and what ends one. It waits for
/// nothing that the studio is about.
class OperatorsBench : public WorkbenchService {
 public:
  /// As which pages know it, also in policies.
  static constexpr const char* kName = "workbench";

  /// @param queue  of the desk's thread
  /// @param wake   has it look there
  OperatorsBench(Seat& seat, EmergencyStops& stops, remote::ControlQueue& queue,
                 std::function<void()> wake)
      : seat_(seat), stops_(stops), queue_(queue), wake_(std::move(wake)) {}

  /// @thread any
  void tell_seat(std::int32_t holder) { publish(SeatChanged{holder}); }

 protected:
  /// Has `work` done by the desk's thread, with the reply that it owes.
  template <typename Result, typename Work>
  void later(ride::ReplyOf<Result>& reply, Work work) {
    const auto owed = std::make_shared<ride::PendingReplyOf<Result>>(reply.keep());
    const bool taken = queue_.post([owed, work = std::move(work)] {
      try {
        work(*owed);
      } catch (const ride::Failure& failure) {
        owed->fail(failure.what());
      }
    });
    if (!taken) owed->fail("the studio has too much to do: ask again");
    wake_();
  }

  Seat& seats() { return seat_; }
  remote::ControlQueue& queue() { return queue_; }
  void wake() { wake_(); }

 private:
  void emergency_stop(ride::ReplyOf<EmergencyStop> reply) override;
  void seat(ride::ReplyOf<SeatState> reply) override;
  void take_seat(ride::ReplyOf<SeatState> reply) override;
  void hand_over(std::int32_t guest, ride::ReplyOf<SeatState> reply) override;
  void leave_seat(ride::ReplyOf<SeatState> reply) override;
  void hold_key(bool down, ride::ReplyOf<double> reply) override;

  SeatState seat_state(const ride::ReplyOf<SeatState>& reply);
  void seated(const base::Result<void>& result, ride::ReplyOf<SeatState>& reply);

  Seat& seat_;
  EmergencyStops& stops_;
  remote::ControlQueue& queue_;
  const std::function<void()> wake_;
};

}  // namespace armature::studio::internal
