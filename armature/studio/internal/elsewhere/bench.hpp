// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "armature/studio/internal/checker.hpp"
#include "armature/studio/internal/elsewhere/application.hpp"
#include "armature/studio/internal/operators_bench.hpp"

namespace armature::studio::internal {

/// An application elsewhere, for pages: it is watched and operated, and there is nothing to be
/// edited, started or stopped.
class ElsewhereBench final : public OperatorsBench {
 public:
  /// @param checker  tells of the models of this machine's libraries
  /// @param ready    whether the run's inspector can be asked
  ElsewhereBench(Elsewhere& application, Checker& checker, std::function<bool()> ready, Seat& seat,
                 EmergencyStops& stops, remote::ControlQueue& queue, std::function<void()> wake)
      : OperatorsBench(seat, stops, queue, std::move(wake)),
        application_(application),
        checker_(checker),
        ready_(std::move(ready)) {}

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

  [[noreturn]] void refuse() const;

  Elsewhere& application_;
  Checker& checker_;
  const std::function<bool()> ready_;
};

}  // namespace armature::studio::internal
