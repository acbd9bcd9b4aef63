// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <pybind11/pybind11.h>

#include "armature/exec/application.hpp"
#include "armature/inspect/application_view.hpp"
#include "armature/inspect/items.hpp"
#include "armature/platform/file.hpp"
#include "python/native/deployed.hpp"

namespace armature::python {

/// A value that was read.
struct Reading {
  pybind11::object value;  ///< None: nobody wrote the port yet
  double age_s = 0.0;      ///< of a port's value
};

/// `start`, `stop`, `reset`, `recover`; anything else is `cleanup`.
inspect::LifeCycleChange change_named(const std::string& name);

/// An application in simulated time, as Python drives it. Its functions give the interpreter's lock
/// away while the application works, and are for one thread at a time, which is the controlling
/// one: another one is refused. None of them is for components, while these are updated.
class Simulation {
 public:
  /// @param record  the folder of its recordings; empty: the working directory
  /// @param grants  acts of the operator, `Arming.arm`, that this program may do
  Simulation(std::shared_ptr<Deployed> deployed, std::string record,
             const std::vector<std::string>& grants);
  ~Simulation();

  base::Diagnostics start();
  /// What is done before a stop, unless something went wrong, and the stop.
  base::Diagnostics stop(bool in_order);
  bool running() const { return application_->running(); }

  /// How far the application's time is [ns].
  /// @thread any
  std::int64_t now_ns() const { return now_ns_.load(std::memory_order_relaxed); }

  /// Why the last stretch of time has ended.
  const char* last_end() const;
  /// Who is out of service; after the stop, who was by then.
  std::vector<exec::Casualty> faults();

  /// Lets time pass, until `condition` is true if it is not None. After the stop there is none that
  /// could, for this function and the next one.
  const char* run_for(base::Duration duration, const pybind11::object& condition);
  /// To the next instant at which something is due.
  void step(base::Duration at_most);

  std::vector<std::string> component_names();
  inspect::ComponentDescription describe(const std::string& component, bool with_values);
  std::vector<inspect::ComponentStatus> components();
  std::vector<exec::LogLine> log(std::uint64_t after);
  /// How often an event was raised since the start.
  std::uint64_t raised(const std::string& component, const std::string& event);
  void change(const std::string& component, const std::string& change);

  Reading read(const std::string& component, const std::string& member);
  void write(const std::string& component, const std::string& member, pybind11::handle value);
  pybind11::object call(const std::string& component, const std::string& operation,
                        const pybind11::tuple& arguments);
  component::CommandHandle begin(const std::string& component, const std::string& command,
                                 const pybind11::tuple& arguments);

 private:
  class Turn;

  exec::RunEnd run_until(base::Time end, const pybind11::object& condition);
  void expect_running() const;
  std::vector<exec::Casualty> faults_now();
  std::vector<exec::Casualty> faults_when_stopped() const;
  void report_new_faults(const std::vector<exec::Casualty>& before, base::Diagnostics& problems);
  inspect::Member find(const std::string& component, const std::string& member);
  inspect::Member find_value(const std::string& component, const std::string& member);
  std::vector<types::Value> arguments_of(const inspect::Member& operation,
                                         const pybind11::tuple& given);

  std::shared_ptr<Deployed> deployed_;
  platform::FolderLock folder_;
  std::optional<exec::Application> application_;
  std::optional<inspect::ApplicationView> view_;
  exec::RunEnd last_end_ = exec::RunEnd::kTimeUp;
  std::atomic<std::int64_t> now_ns_{0};
  std::atomic<std::thread::id> driver_{};
  int depth_ = 0;  ///< calls of the driver that are under way, one within the other
};

}  // namespace armature::python
