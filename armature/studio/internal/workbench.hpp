// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

#include "armature/remote/control_queue.hpp"
#include "armature/studio/internal/desk.hpp"
#include "armature/studio/internal/emergency_stop.hpp"
#include "armature/studio/internal/seat.hpp"
#include "workbench_service.hpp"

namespace armature::studio::internal {

/// The desk for pages: requests wait in a queue for the thread that works at the desk. What ends a
/// motion, and who may begin one, waits for nothing there.
class Workbench final : public WorkbenchService {
 public:
  /// As which pages know it, also in policies.
  static constexpr const char* kName = "workbench";

  /// @param queue  of the desk's thread
  /// @param wake   has it look there
  Workbench(Desk& desk, Seat& seat, EmergencyStops& stops, remote::ControlQueue& queue,
            std::function<void()> wake)
      : desk_(desk), seat_(seat), stops_(stops), queue_(queue), wake_(std::move(wake)) {}

  /// Tells pages that something is other than before.
  /// @thread the desk's
  void tell_project();
  void tell_run();
  /// @thread any
  void tell_seat(std::int32_t holder);

 private:
  void project(ride::ReplyOf<ProjectState> reply) override;
  void text(const std::string& path, ride::ReplyOf<std::string> reply) override;
  void edit(const Edit& what, ride::ReplyOf<Outcome> reply) override;
  void write(std::int32_t version, const std::string& path, const std::string& text,
             ride::ReplyOf<Outcome> reply) override;
  void undo(ride::ReplyOf<Outcome> reply) override;
  void redo(ride::ReplyOf<Outcome> reply) override;
  void save(ride::ReplyOf<Outcome> reply) override;
  void reload(ride::ReplyOf<Outcome> reply) override;
  void check(ride::ReplyOf<std::string> reply) override;
  void fitting(const std::string& component, const std::string& member,
               ride::ReplyOf<std::string> reply) override;
  void models(ride::ReplyOf<std::string> reply) override;
  void places(ride::ReplyOf<std::string> reply) override;
  void start(const RunSettings& settings, ride::ReplyOf<RunState> reply) override;
  void stop(ride::ReplyOf<RunState> reply) override;
  void run(ride::ReplyOf<RunState> reply) override;
  void log(std::int32_t from, ride::ReplyOf<std::vector<std::string>> reply) override;
  void description(const std::string& path, ride::ReplyOf<std::string> reply) override;
  void emergency_stop(ride::ReplyOf<EmergencyStop> reply) override;
  void seat(ride::ReplyOf<SeatState> reply) override;
  void take_seat(ride::ReplyOf<SeatState> reply) override;
  void hand_over(std::int32_t guest, ride::ReplyOf<SeatState> reply) override;
  void leave_seat(ride::ReplyOf<SeatState> reply) override;
  void hold_key(bool down, ride::ReplyOf<double> reply) override;

  SeatState seat_state(const ride::ReplyOf<SeatState>& reply);
  void seated(const base::Result<void>& result, ride::ReplyOf<SeatState>& reply);
  template <typename Result, typename Work>
  void later(ride::ReplyOf<Result>& reply, Work work);
  template <typename Work>
  void change(ride::ReplyOf<Outcome>& reply, Work work);
  Checker::Then forward(ride::ReplyOf<std::string>& reply);

  ProjectState project_state() const;
  RunState run_state() const;
  Outcome outcome_of(const base::Diagnostics& diagnostics) const;
  Outcome outcome_of(const base::Result<void>& result) const;

  Desk& desk_;
  Seat& seat_;
  EmergencyStops& stops_;
  remote::ControlQueue& queue_;
  const std::function<void()> wake_;
};

}  // namespace armature::studio::internal
