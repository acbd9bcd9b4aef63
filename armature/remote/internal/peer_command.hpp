// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "armature/base/time.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/ride/origin.hpp"

namespace armature::remote::internal {

/// A command that a peer has begun: it lasts no longer than the connection by which it was asked
/// for, since nobody else would take it back.
/// @thread the controlling one
class PeerCommand {
 public:
  /// Is told what the operator should know.
  using Tell = std::function<void(const std::string&)>;

  PeerCommand(component::CommandHandle handle, ride::Origin origin)
      : handle_(std::move(handle)), line_(std::move(origin)) {}

  component::CommandHandle& handle() { return handle_; }
  const component::CommandHandle& handle() const { return handle_; }

  /// Cancels it if its peer has gone, or is silent: what moves comes to rest.
  /// @param name  of the command, for `tell`
  /// @param now   of the monotonic clock
  void cancel_if_lost(const std::string& name, base::Time now, const Tell& tell) {
    if (cancelled_ || handle_.ended() || !line_.lost(now)) return;
    cancelled_ = true;
    handle_.cancel();
    if (tell)
      tell("'" + name + "' is cancelled: the connection to " + line_.who() +
           ", which began it, is lost");
  }

 private:
  component::CommandHandle handle_;
  ride::Lifeline line_;
  bool cancelled_ = false;
};

}  // namespace armature::remote::internal
