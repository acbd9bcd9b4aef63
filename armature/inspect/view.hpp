// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/exec/observing/log_history.hpp"
#include "armature/exec/pace.hpp"
#include "armature/inspect/connections.hpp"
#include "armature/inspect/describe.hpp"
#include "armature/inspect/status.hpp"
#include "armature/types/enum.hpp"

namespace armature::inspect {

/// Thrown by a view whose application cannot be asked, or not for this.
class NoAnswer : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The application itself refuses, or knows no such thing; the text says what to do.
class Refusal : public NoAnswer {
 public:
  using NoAnswer::NoAnswer;
};

/// A value or a part of one.
struct ItemValue {
  std::string item;  ///< as it was asked for
  std::string kind;  ///< `property`, `attribute`, `input` or `output`
  std::string type;  ///< empty: nothing that could ever be looked at
  std::string unit;
  std::string value;     ///< as files have it: `0.5`, `[1, 2]`, `{x: 1, y: 2}`
  bool written = false;  ///< false: nobody wrote the port yet
  base::Duration age{};  ///< of a port's value
  std::string error;     ///< why there is no value; otherwise empty

  bool operator==(const ItemValue&) const = default;
};

/// What an operation gave.
struct CallResult {
  bool given = false;  ///< false: the operation has no result
  std::string type;
  std::string value;

  bool operator==(const CallResult&) const = default;
};

/// A number that is watched: an item, or a part of one that has several.
struct WatchedItem {
  std::string item;  ///< `Joint1.Position`, `Sensor.sensor[2]`
  std::string unit;

  bool operator==(const WatchedItem&) const = default;
};

/// Numbers that are looked at again and again.
struct Watch {
  std::int32_t handle = 0;
  std::vector<WatchedItem> items;

  bool operator==(const Watch&) const = default;
};

/// What watched numbers were last.
struct WatchedValues {
  std::vector<double> values;  ///< NaN: the port was never written, or its list is shorter now
  std::vector<double> ages;    ///< [s] since the port was written; NaN: never
  std::uint64_t replaced = 0;  ///< samples that newer ones replaced before they were taken

  bool operator==(const WatchedValues&) const = default;
};

/// What a component did in a cycle, without those that it called.
struct CycleStep {
  std::string component;   ///< empty: one that is not asked for
  base::Duration begin{};  ///< since the cycle's
  base::Duration length{};

  bool operator==(const CycleStep&) const = default;
};

/// One cycle of a thread, step by step.
struct Cycle {
  std::uint64_t number = 0;  ///< the thread's, from 1; 0: none was recorded yet
  base::Time time{};         ///< that components were told
  base::Duration length{};
  std::vector<CycleStep> steps;  ///< in the order of their begin
  std::uint64_t left_out = 0;    ///< steps that found no room

  bool operator==(const Cycle&) const = default;
};

/// Lines of a log, one after the other.
struct LogLines {
  std::vector<exec::LogLine> lines;
  std::uint64_t left_out = 0;  ///< before the first: too old, or not asked for

  bool operator==(const LogLines&) const = default;
};

/// A step in a component's life.
enum class LifeCycleChange : std::uint8_t { kStart, kStop, kReset, kRecover, kCleanup };
ARMATURE_ENUM(LifeCycleChange, kStart, kStop, kReset, kRecover, kCleanup);

/// A running application as tools see it, and what they do with it: of this process
/// (ApplicationView) or another (remote::PeerView). Several views may attend one application, each
/// with the commands that it began; their requests are done one after the other.
///
/// Values are text, as files have them. Every function throws NoAnswer.
/// @thread one at a time; a source may say more
class View {
 public:
  /// Which components are asked for, by their names.
  using Which = std::function<bool(const std::string& component)>;

  View() = default;
  View(const View&) = delete;
  View& operator=(const View&) = delete;
  virtual ~View() = default;

  /// In the order of the deployment, as for all lists of components.
  virtual std::vector<std::string> component_names() = 0;

  virtual ApplicationStatus status() = 0;
  virtual std::vector<ComponentStatus> components(const Which& which) = 0;
  std::vector<ComponentStatus> components() { return components(everyone); }
  virtual Faults faults(const Which& which) = 0;
  Faults faults() { return faults(everyone); }

  /// A component's whole interface.
  /// @param values  kIncluded: how it stands and its values, all at one moment. kLeftOut: its
  ///                thread is not asked, and how it stood may be an earlier time's.
  virtual ComponentDescription describe(const std::string& component, Values values) = 0;

  /// Those of which both ends are at components that are asked for.
  virtual std::vector<Connection> connections(const Which& which) = 0;
  std::vector<Connection> connections() { return connections(everyone); }

  /// Values by their items, `Joint1.Position`, `Sensor.sensor[2]` (counted from 1),
  /// `Settings.Gains.kp`: of each component all at one moment. What is wrong with one item is its
  /// `error`.
  virtual std::vector<ItemValue> read(const std::vector<std::string>& items) = 0;

  /// Has the threads of properties and ports copy all numbers in them after a cycle, no more often
  /// than `interval`, so that many can be looked at often. Of lists those that are there now. It
  /// ends with the run, with the connection, or by `end_watch`.
  virtual Watch watch(const std::vector<std::string>& items, base::Duration interval) = 0;
  virtual WatchedValues watched(std::int32_t handle) = 0;
  virtual void end_watch(std::int32_t handle) = 0;

  /// The cycle of a thread that was recorded last, and has the thread record its next one: who
  /// looks again and again sees ever newer ones.
  /// @param which  components whose steps have their names
  virtual Cycle cycle(const std::string& thread, const Which& which) = 0;
  Cycle cycle(const std::string& thread) { return cycle(thread, everyone); }

  /// Lines of the log that were written after the one with the number `after`; 0: as far back as
  /// they are kept. At most 100: the oldest of them, so that who asks again from the last one
  /// misses none.
  /// @param which  whose lines: components', threads', the `application`'s
  virtual LogLines log(std::uint64_t after, const Which& which) = 0;
  LogLines log(std::uint64_t after) { return log(after, everyone); }

  /// Sets a property. A number may have a unit, which is converted to the property's.
  /// @return what it is now
  virtual ItemValue write(const std::string& item, const std::string& value) = 0;

  /// Calls an operation and waits for its end; a command is begun, and its end not waited for.
  virtual CallResult call(const std::string& component, const std::string& operation,
                          const std::vector<std::string>& arguments) = 0;

  /// Begins a command. Its handle is good until 256 others were begun after it has ended.
  virtual CommandStatus begin(const std::string& component, const std::string& command,
                              const std::vector<std::string>& arguments) = 0;
  virtual CommandStatus follow(std::int32_t handle) = 0;
  virtual CommandStatus cancel(std::int32_t handle) = 0;

  /// @return how the component stands now; one that holds something may be on its way to the stop
  virtual ComponentStatus change(const std::string& component, LifeCycleChange change) = 0;

  /// How simulated time passes. Real time cannot be paced, which is a Refusal of the other two.
  virtual exec::Pace pace() = 0;
  /// @return how it passes now
  virtual exec::Pace set_pace(const exec::Pace& pace) = 0;
  /// Paused simulated time goes on to the next instant at which something is due.
  virtual exec::Pace step() = 0;

 protected:
  static bool everyone(const std::string&) { return true; }
};

}  // namespace armature::inspect
