// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "armature/ride/transport.hpp"

namespace armature::browser {

/// Which application is browsed, and over what.
struct RemoteBrowserOptions {
  std::string address;  ///< where the application's process listens
  /// Beside TCP and Unix-domain sockets.
  std::vector<std::shared_ptr<ride::Transport>> transports;
};

/// The task browser for an application of another process, until the operator leaves: lines of the
/// standard input look at it and command it; docs/browser.md has their language. A connection that
/// is lost comes back by itself.
/// @param problem  why the process cannot be reached; otherwise left empty
/// @return lines that were mistakes, if no terminal was there to see that
std::size_t browse_remotely(const RemoteBrowserOptions& options, std::string& problem);

}  // namespace armature::browser
