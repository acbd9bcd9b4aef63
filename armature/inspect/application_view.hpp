// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "armature/exec/application.hpp"
#include "armature/inspect/view.hpp"

namespace armature::inspect {

namespace internal {
class BegunCommands;
}

/// The view of an application of this process. What it asks for costs the application's threads no
/// more than a message between two cycles; a component's thread that hangs is waited for as long as
/// the application's hook limit says.
/// @thread the controlling one, which may do a tool's requests between whatever else it does;
///         `component_names` any
class ApplicationView final : public View {
 public:
  /// Commands that it remembers; of those that have ended the oldest is forgotten.
  static constexpr std::size_t kMostCommands = 256;
  /// Numbers of a watch.
  static constexpr std::size_t kMostNumbers = 4096;
  /// How many log lines one answer has.
  static constexpr std::size_t kMostLogLines = 100;

  /// @param application  outlives it
  /// @param caller       on whose behalf it writes, calls and begins
  explicit ApplicationView(exec::Application& application,
                           exec::Caller caller = exec::Caller::kOperator);
  ~ApplicationView() override;

  std::vector<std::string> component_names() override;
  ApplicationStatus status() override;
  using View::components;
  std::vector<ComponentStatus> components(const Which& which) override;
  using View::faults;
  Faults faults(const Which& which) override;
  ComponentDescription describe(const std::string& component, Values values) override;
  using View::connections;
  std::vector<Connection> connections(const Which& which) override;
  std::vector<ItemValue> read(const std::vector<std::string>& items) override;
  Watch watch(const std::vector<std::string>& items, base::Duration interval) override;
  WatchedValues watched(std::int32_t handle) override;
  void end_watch(std::int32_t handle) override;
  using View::cycle;
  Cycle cycle(const std::string& thread, const Which& which) override;
  using View::log;
  LogLines log(std::uint64_t after, const Which& which) override;
  ItemValue write(const std::string& item, const std::string& value) override;
  CallResult call(const std::string& component, const std::string& operation,
                  const std::vector<std::string>& arguments) override;
  CommandStatus begin(const std::string& component, const std::string& command,
                      const std::vector<std::string>& arguments) override;
  CommandStatus follow(std::int32_t handle) override;
  CommandStatus cancel(std::int32_t handle) override;
  ComponentStatus change(const std::string& component, LifeCycleChange change) override;
  exec::Pace pace() override;
  exec::Pace set_pace(const exec::Pace& pace) override;
  exec::Pace step() override;

  /// Whether `follow` knows the command.
  bool remembers(std::int32_t handle) const;
  /// Whether it was begun and has not ended.
  bool is_under_way(std::int32_t handle) const;
  /// What is said of a handle that it does not remember.
  static std::string unknown_command(std::int32_t handle);

 private:
  component::Component& find(const std::string& name) const;

  exec::Application& application_;
  exec::Caller caller_;
  std::unique_ptr<internal::BegunCommands> commands_;
};

}  // namespace armature::inspect
