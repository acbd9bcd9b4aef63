// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <utility>

#include "armature/studio/internal/desk.hpp"
#include "armature/studio/internal/operators_bench.hpp"

namespace armature::studio::internal {

/// The desk for pages: requests wait in a queue for the thread that works at the desk.
class Workbench final : public OperatorsBench {
 public:
  Workbench(Desk& desk, Seat& seat, EmergencyStops& stops, remote::ControlQueue& queue,
            std::function<void()> wake)
      : OperatorsBench(seat, stops, queue, std::move(wake)), desk_(desk) {}

  /// Tells pages that something is other than before.
  /// @thread the desk's
  void tell_project();
  void tell_run();

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

  template <typename Work>
  void change(ride::ReplyOf<Outcome>& reply, Work work);
  Checker::Then forward(ride::ReplyOf<std::string>& reply);

  ProjectState project_state() const;
  RunState run_state() const;
  Outcome outcome_of(const base::Diagnostics& diagnostics) const;
  Outcome outcome_of(const base::Result<void>& result) const;

  Desk& desk_;
};

}  // namespace armature::studio::internal
