// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/diagnostic.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/exec/plan.hpp"

namespace armature::exec::internal {

/// All that leads from one component to another, made and taken apart as the plan has it.
class Connections {
 public:
  /// @param output_folder  where the files of observers go
  Connections(const Blueprint& blueprint, const Plan& plan, const std::string& output_folder)
      : blueprint_(blueprint), plan_(plan), output_folder_(output_folder) {}

  /// Has readers react to old data and lost writers as the connections say.
  void declare_reactions() const;
  /// Makes them all, when all components have been configured; names those whose sizes differ.
  void make(base::Diagnostics& diagnostics) const;
  void undo() const;

 private:
  void connect(const ConnectionPlan& connection, base::Diagnostics& diagnostics) const;
  void let_observers_look() const;

  const Blueprint& blueprint_;
  const Plan& plan_;
  const std::string& output_folder_;
};

}  // namespace armature::exec::internal
