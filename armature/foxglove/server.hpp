// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "armature/base/result.hpp"
#include "armature/remote/inspector.hpp"
#include "armature/ride/peer.hpp"
#include "armature/websocket/messages.hpp"

namespace armature::foxglove {

/// As policies know its clients: `foxglove@web`.
inline constexpr const char* kIdentity = "foxglove";

/// For websocket::Options::messages: with it the server of pages speaks Foxglove's protocol, too.
std::shared_ptr<websocket::Messages> make_messages();

/// What an application's node has beside its inspector, for one client.
/// @thread the server's
class Companion {
 public:
  virtual ~Companion() = default;
  /// The text of a robot's description (URDF).
  /// @param path  as a component's property `robot_description` has it
  virtual base::Result<std::string> description(const std::string& path) = 0;
  /// The ports that move robots, where somebody has chosen them, by the robots' components.
  virtual std::map<std::string, std::string> chosen_ports() { return {}; }
  /// Once a second.
  virtual void attend() {}
};

/// What a server offers.
struct ServerOptions {
  /// As which the node hosts the inspector of the application.
  std::string inspector = remote::Inspector::kName;
  /// Made for each client, of its own connection to the node.
  std::function<std::unique_ptr<Companion>(ride::Peer&)> companion;
};

/// An application for Foxglove (docs/foxglove.md): its ports as channels, its properties as
/// parameters, its robots as a scene. It asks the application's inspector for each client by a
/// connection of that client's own, so the node's policy decides what the client sees and sets.
/// Nothing is called, begun, started or stopped.
///
/// It works in a thread of its own, and never in one of the application.
class Server {
 public:
  /// @param messages  of the server of pages
  Server(std::shared_ptr<websocket::Messages> messages, ServerOptions options);
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  /// Waits for what it has asked: after the services of the node are removed.
  ~Server();

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace armature::foxglove
