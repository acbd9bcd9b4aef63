// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/browser/internal/answers.hpp"
#include "armature/browser/internal/spelled_view.hpp"
#include "armature/browser/internal/words.hpp"
#include "armature/component/component.hpp"

namespace armature::browser::internal {

/// The commands that start and stop components, and take them out of faults.
class LifeCycle {
 public:
  /// @param view, answers  outlive it
  LifeCycle(SpelledView& view, Answers& answers) : view_(view), answers_(answers) {}

  /// These components; for no names all that rest and that the deployment starts.
  void start(const Words& names);
  /// @param quitting  what `quit` does, which may have been meant
  void stop(const Words& names, std::string_view quitting);
  void reset(const Words& names);
  void recover(const Words& names);
  void clean_up(const Words& names);

 private:
  /// @return whose change was not refused
  Words change(const Words& names, inspect::LifeCycleChange change);
  void start_those_that_stopped_again(const Words& started);
  Words all_in(component::State state);

  SpelledView& view_;
  Answers& answers_;
};

}  // namespace armature::browser::internal
