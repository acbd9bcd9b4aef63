// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/exec/black_box.hpp"
#include "armature/exec/engine.hpp"
#include "armature/exec/internal/incidents.hpp"
#include "armature/exec/plan.hpp"

namespace armature::exec::internal {

/// The black boxes of an application's threads, and when they are written.
class BlackBoxes {
 public:
  explicit BlackBoxes(BlackBoxOptions options) : options_(std::move(options)) {}

  /// Has the engines, one for each thread of the plan, keep one each. All ports have their shape.
  void set_engines(const std::vector<std::unique_ptr<Engine>>& engines, const Blueprint& blueprint,
                   const Plan& plan, bool simulated);

  /// Writes what led to a fault, and what came of it for a moment.
  /// @return what became of it; empty if there was nothing to write
  std::string write_if_due(Incidents& incidents, base::Time now);
  /// The same at once: nothing will come.
  std::string write_last(Incidents& incidents, base::Time now);

 private:
  using Box = component::BlackBox;
  struct Kept {
    std::shared_ptr<Box> box;
    std::string thread;
  };

  std::string write(const component::Component& first, base::Time now);
  bool is_another_kind(const BlackBoxReport& report);
  BlackBoxReport report_of(const component::Component& first, base::Time now) const;
  void add_box(const Kept& kept, BlackBoxReport& report) const;

  BlackBoxOptions options_;
  std::vector<Kept> boxes_;
  std::optional<base::Time> noticed_;
  int written_ = 0;
  std::vector<std::string> kinds_;  ///< of the faults that were written
};

}  // namespace armature::exec::internal
