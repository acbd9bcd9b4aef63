// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/exec/application.hpp"
#include "armature/replay/acts.hpp"

namespace armature::replay {

/// Lets an application run in simulated time as it ran when it was recorded: does each act at its
/// instant, between the same turns of threads.
/// @thread the controlling one
class Reenactment {
 public:
  /// @param acts  of the recorded run, in their order
  explicit Reenactment(std::vector<RecordedAct> acts) : acts_(std::move(acts)) {}

  /// For `exec::ApplicationOptions::attend` of the application, which is not made yet: does what
  /// tools did while they were attended to.
  void attend();

  /// From the start of the application to the end of the recorded run, or `until`.
  /// @param at_instant  looks on whenever all that is due at an instant is done; false ends it
  /// @return how it ended: kTimeUp at its end or `until`, kConditionMet if `at_instant` did
  exec::RunEnd run(exec::Application& application, base::Time until,
                   const std::function<bool()>& at_instant);

  /// What could not be done as it was: acts that name what is not there any more, or whose values
  /// have another type now.
  const base::Diagnostics& problems() const { return problems_; }
  /// The account of acts has no end: the recorded run was killed.
  bool cut_off() const;

 private:
  using Value = types::Value;

  bool is_due(const exec::Act& act) const;
  const exec::Act* next_between() const;
  const RecordedAct* take_next();
  void perform(const RecordedAct& recorded);
  void perform(const exec::Act& act, std::vector<Value> values);
  std::optional<std::vector<Value>> values_of(const RecordedAct& recorded);
  std::optional<std::vector<const types::Type*>> types_of(const exec::Act& act);
  void write(const exec::Act& act, const Value& value);
  void complain(const exec::Act& act, const std::string& why);

  std::vector<RecordedAct> acts_;
  std::size_t next_ = 0;
  exec::Application* application_ = nullptr;
  std::map<std::uint32_t, component::CommandHandle> commands_;  ///< by their numbers
  base::Diagnostics problems_;
};

}  // namespace armature::replay
