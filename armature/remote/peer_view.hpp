// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/inspect/view.hpp"
#include "armature/ride/peer.hpp"

namespace armature::remote {

/// The view of an application of another process, whose node hosts an Inspector; of a node without
/// one only the components that its directory lists. What the peer says comes without characters
/// that would move a terminal's cursor. The peer refuses what its policy does not allow; a function
/// waits up to 15 s for the answer.
/// @thread one at a time, none of the node's own; never on a real-time thread
class PeerView final : public inspect::View {
 public:
  /// @param peer  outlives it
  /// The inspector is named as the peer hosts it: a studio has another name for its run's.
  explicit PeerView(ride::Peer& peer);
  PeerView(ride::Peer& peer, const std::string& inspector);
  ~PeerView() override;

  /// As they were first listed, until `forget`.
  std::vector<std::string> component_names() override;
  inspect::ApplicationStatus status() override;
  using View::components;
  std::vector<inspect::ComponentStatus> components(const Which& which) override;
  using View::faults;
  inspect::Faults faults(const Which& which) override;
  /// Without values as it was described last, until `forget`.
  inspect::ComponentDescription describe(const std::string& component,
                                         inspect::Values values) override;
  using View::connections;
  std::vector<inspect::Connection> connections(const Which& which) override;
  std::vector<inspect::ItemValue> read(const std::vector<std::string>& items) override;
  inspect::ItemValue write(const std::string& item, const std::string& value) override;
  inspect::CallResult call(const std::string& component, const std::string& operation,
                           const std::vector<std::string>& arguments) override;
  inspect::CommandStatus begin(const std::string& component, const std::string& command,
                               const std::vector<std::string>& arguments) override;
  inspect::CommandStatus follow(std::int32_t handle) override;
  inspect::CommandStatus cancel(std::int32_t handle) override;
  inspect::ComponentStatus change(const std::string& component,
                                  inspect::LifeCycleChange change) override;
  inspect::Watch watch(const std::vector<std::string>& items, base::Duration interval) override;
  inspect::WatchedValues watched(std::int32_t handle) override;
  void end_watch(std::int32_t handle) override;
  using View::cycle;
  inspect::Cycle cycle(const std::string& thread, const Which& which) override;
  using View::log;
  inspect::LogLines log(std::uint64_t after, const Which& which) override;
  exec::Pace pace() override;
  exec::Pace set_pace(const exec::Pace& pace) override;
  exec::Pace step() override;

  /// Whether an application answers there, and not only a node; one that has just been started is
  /// not there at once, which is told as a change.
  bool has_application();
  const std::string& address() const;
  bool connected() const;
  base::Result<void> wait_until_connected(base::Duration limit) const;

  /// What became of the connection since this was asked last.
  std::vector<ride::PeerChange> take_changes();
  /// Forgets what it knows of the components: they may be others now.
  void forget();

 private:
  class Client;
  std::unique_ptr<Client> client_;
};

}  // namespace armature::remote
