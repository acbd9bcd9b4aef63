// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "armature/base/diagnostic.hpp"
#include "armature/platform/file.hpp"
#include "armature/ride/node.hpp"
#include "armature/studio/server.hpp"
#include "armature/websocket/transport.hpp"

namespace armature::studio::internal {

/// As which pages know the run's inspector, also in policies.
inline constexpr const char* kRunName = "run";

/// By which pages come in: a studio's folder, which is its own alone, and what its node needs.
struct Entrance {
  std::string folder;
  std::optional<platform::FolderLock> lock;
  std::shared_ptr<websocket::Messages> messages;  ///< of Foxglove's clients
  std::shared_ptr<websocket::Transport> transport;
  ride::NodeOptions node;
};

/// @param subject  what the studio has open: the path of a deployment, or an address
/// @return nothing after an error
std::optional<Entrance> make_entrance(const ServerOptions& options, const std::string& subject,
                                      base::Diagnostics& diagnostics);

}  // namespace armature::studio::internal
