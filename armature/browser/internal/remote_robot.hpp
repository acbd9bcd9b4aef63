// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/browser/internal/robot.hpp"
#include "armature/ride/peer.hpp"
#include "inspection_client.hpp"

namespace armature::browser::internal {

/// The application of another process, whose node hosts an inspector; of a node without one only
/// the components that its directory lists. What it says comes without characters that would move
/// a terminal's cursor.
class RemoteRobot final : public Robot {
 public:
  /// @param peer  outlives it
  explicit RemoteRobot(ride::Peer& peer);

  std::vector<std::string> component_names() override;
  std::string find(std::string_view text) override;
  std::string spelled(const std::string& component) const override { return component; }
  remote::ApplicationStatus status() override;
  std::vector<remote::ComponentStatus> components() override;
  remote::Faults faults() override;
  remote::ComponentDetails look_at(const std::string& component) override;
  remote::ComponentDetails interface_of(const std::string& component) override;
  std::vector<remote::ItemValue> read(const std::vector<std::string>& items,
                                      std::size_t most_elements) override;
  Changed change(const std::string& component, const std::string& change) override;

  remote::ItemValue write(const std::string& item, const std::string& value);
  /// What the operation gave, for people; empty if it gives nothing.
  std::string call(const std::string& component, const std::string& operation,
                   const std::vector<std::string>& arguments);
  remote::CommandStatus begin(const std::string& component, const std::string& command,
                              const std::vector<std::string>& arguments);
  remote::CommandStatus follow(std::int32_t handle);
  remote::CommandStatus cancel(std::int32_t handle);

  /// Whether an application answers there, and not only a node; one that has just been started is
  /// not there at once, which is told as a change.
  bool has_application();
  const std::string& address() const { return peer_.address(); }
  bool connected() const { return peer_.connected(); }
  base::Result<void> wait_until_connected(base::Duration limit) const {
    return peer_.wait_until_connected(limit);
  }

  /// What became of the connection since this was asked last.
  std::vector<ride::PeerChange> take_changes();
  /// Forgets what it knows of the components: they may be others now.
  void forget();

 private:
  template <typename T>
  T take(ride::Answer<T> answer) const;
  const std::vector<ride::PeerComponent>& hosted();
  std::vector<remote::FieldDetails> fields_of(const remote::ItemValue& value);
  void shorten(remote::ComponentDetails& details) const;

  ride::Peer& peer_;
  remote::InspectorPlaceholder inspector_;
  std::vector<ride::PeerComponent> hosted_;
  std::optional<bool> has_application_;
  std::vector<std::string> names_;
  std::map<std::string, remote::ComponentDetails, std::less<>> known_;
  std::mutex mutex_;
  std::vector<ride::PeerChange> changes_;  ///< with the lock
  ride::Subscription watch_;
};

}  // namespace armature::browser::internal
