// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/exec/application.hpp"
#include "armature/replay/acts.hpp"
#include "armature/replay/alone.hpp"

namespace armature::replay {

/// An act that was done when the run was recorded and is refused now, or the other way round.
struct ChangedOutcome {
  exec::Act act;  ///< without values
  std::string was;
  std::string is;
};

/// With such an act a run begins to end.
bool is_of_the_end(const exec::Act& act);

/// When an act is due. The same turns of threads are those of the same deployment only: who changed
/// it goes by the time.
enum class DueBy : std::uint8_t { kTurn, kTime };

/// Lets an application run in simulated time as it ran when it was recorded: does each act at its
/// instant, between the same turns of threads.
/// @thread the controlling one
class Reenactment {
 public:
  /// @param acts  of the recorded run, in their order
  Reenactment(std::vector<RecordedAct> acts, DueBy due) : acts_(std::move(acts)), due_(due) {}

  /// For `exec::ApplicationOptions::attend` of the application, which is not made yet: does what
  /// tools did while they were attended to.
  void attend();

  /// From the start of the application to the end of the recorded run, or `until`.
  /// @param alone  of components that run again without the others; may be null
  /// @param at_instant  looks on whenever all that is due at an instant is done; false ends it
  /// @return how it ended: kTimeUp at its end or `until`, kConditionMet if `at_instant` did
  exec::RunEnd run(exec::Application& application, base::Time until,
                   const std::function<bool()>& at_instant, const Alone* alone = nullptr);

  /// What did not end as it did, or could not be done: acts that name what is not there any more,
  /// whose values have another type now, or whose turn did not come.
  const std::vector<ChangedOutcome>& changed() const { return changed_; }
  /// The account of acts has no end: the recorded run was killed.
  bool cut_off() const;

 private:
  using Value = types::Value;

  bool is_due(const exec::Act& act) const;
  const exec::Act* next_between() const;
  const RecordedAct* take_next();
  void perform(const RecordedAct& recorded);
  std::string perform(const exec::Act& act, std::vector<Value> values);
  base::Result<std::vector<Value>> values_of(const RecordedAct& recorded);
  base::Result<std::vector<const types::Type*>> types_of(const exec::Act& act);
  std::string write(const exec::Act& act, const Value& value);
  void compare(const RecordedAct& recorded, const std::string& refused);

  std::vector<RecordedAct> acts_;
  DueBy due_;
  std::size_t next_ = 0;
  exec::Application* application_ = nullptr;
  std::map<std::uint32_t, component::CommandHandle> commands_;  ///< by their numbers
  std::vector<ChangedOutcome> changed_;
};

}  // namespace armature::replay
