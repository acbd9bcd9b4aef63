// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/component.hpp"
#include "armature/component/events/event.hpp"
#include "armature/component/states/machine_table.hpp"
#include "armature/component/states/state_definition.hpp"
#include "armature/component/step.hpp"
#include "armature/component/trigger.hpp"

namespace armature::component {

/// A hierarchical state machine of a component, in one thread with it.
///
/// - Starting the component enters the initial state, the first that is listed, and its initial
///   substates; stopping it, or a fault, leaves all states.
/// - A trigger is handled at once and to completion: the innermost active state that has an allowed
///   transition for it decides, its transitions tried in the order in which they are listed. A
///   trigger for which there is none is ignored and counted. What is raised by an action of the
///   machine itself is handled next, in order, after the present transition.
/// - A transition leaves the states between the current one and the innermost state that contains
///   both its source and its target, inner first; then comes its action; then it enters those down
///   to the target, outer first, and the target's initial substates. So a transition from a state
///   to itself leaves and enters it. One without a target only carries out its action.
/// - Entering a final substate makes its parent done, and its `when_done` transition is taken next.
/// - Each step, before the component's update: at most one transition on time or condition, again
///   from the innermost state outwards; then the `during` actions of all active states, outer
///   first.
///
/// An exception in an action faults the component. If 64 triggers in a row cause the next one, that
/// is a fault as well.
class StateMachine final : public Step {
 public:
  /// The states of a machine that is written in C++; see state_definition.hpp.
  template <typename... States>
  StateMachine(Component* owner, std::string_view name, std::string_view doc,
               States... states) noexcept
      : StateMachine(*owner, name, doc) {
    StateDefinition root("");
    (root.apply(std::move(states)), ...);
    define(root);
  }

  /// A machine as data, as scripts make it. Actions without `self` are given the component.
  StateMachine(Component* owner, std::string_view name, std::string_view doc, MachineTable table);

  StateMachine(const StateMachine&) = delete;
  StateMachine& operator=(const StateMachine&) = delete;
  ~StateMachine();

  const std::string& name() const { return name_; }
  const std::string& doc() const { return doc_; }
  Component& owner() const { return owner_; }
  const MachineTable& table() const { return table_; }
  /// What is wrong with the definition; the component refuses to be configured then.
  const std::vector<std::string>& problems() const { return problems_; }

  /// The innermost active state, kNoState while the component does not run.
  /// @rt nonblocking, no allocation
  /// @thread any
  int current() const { return current_.load(std::memory_order_relaxed); }
  /// The active states as text, such as `Moving/Decelerating`; empty while the component does not
  /// run.
  /// @rt nonblocking, no allocation
  /// @thread any
  std::string_view path() const;
  /// True if `state`, given by its whole path, is active.
  /// @rt nonblocking, no allocation
  /// @thread any
  bool is_in(std::string_view state) const;

  /// Handles a trigger, given by its index in the table.
  /// @rt nonblocking, no allocation, as the actions are
  /// @thread the component's own
  TriggerStatus post(std::size_t trigger);

  /// @thread the component's own
  std::uint64_t transitions_taken() const { return taken_; }
  std::uint64_t triggers_ignored() const { return ignored_; }
  std::uint64_t triggers_refused() const { return refused_; }

  void start() override;
  void step() override;
  void halt(std::string_view reason) override;

  /// Triggers that may wait because an action of the machine raised them.
  static constexpr std::size_t kQueue = 16;

 private:
  struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  class Busy;
  class OwnEvent;

  StateMachine(Component& owner, std::string_view name, std::string_view doc) noexcept;
  void define(const StateDefinition& root);
  void define_states(const StateDefinition& definition, int parent);
  void define_transitions(const StateDefinition& definition, int& state);
  std::size_t index_of(const TransitionDefinition& definition);
  void prepare();

  const MachineState& at(int state) const { return table_.states[static_cast<std::size_t>(state)]; }
  bool handle(std::size_t trigger);
  template <typename Applies>
  bool take_first(int innermost, const Applies& applies);
  bool take_when_due();
  bool take_when_done();
  void take(const MachineTransition& transition);
  void settle();
  bool run_during_actions(int state);
  bool enter_substates(bool from_history);
  bool enter_down_to(int target, int outer);
  bool enter(int state);
  bool leave(int state);
  bool perform(const MachineAction& action, int changing = kNoState);

  Component& owner_;
  std::string name_;
  std::string doc_;
  MachineTable table_;
  std::vector<std::string> problems_;

  std::vector<std::string> paths_;
  std::vector<int> initial_;
  std::vector<int> last_;  ///< substate that was active when a state was left
  std::vector<base::Time> entered_at_;
  std::vector<Range> transitions_of_;
  std::vector<std::pair<const void*, std::size_t>> trigger_indices_;
  std::vector<std::unique_ptr<OwnEvent>> own_events_;

  std::atomic<int> current_{kNoState};  ///< for tools: keeps its value while states are left
  int innermost_ = kNoState;
  int changing_ = kNoState;  ///< whose entry or exit action runs now
  bool active_ = false;
  bool busy_ = false;
  std::uint32_t life_ = 0;  ///< counts the halts, so that what one interrupted is not resumed
  std::array<std::size_t, kQueue> queue_{};
  std::size_t queue_begin_ = 0;
  std::size_t queued_ = 0;
  std::uint64_t taken_ = 0;
  std::uint64_t ignored_ = 0;
  std::uint64_t refused_ = 0;
};

}  // namespace armature::component
