// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "armature/ride/internal/link.hpp"
#include "armature/ride/internal/node/access_control.hpp"
#include "armature/ride/internal/node/directory_service.hpp"
#include "armature/ride/internal/node/hosted_services.hpp"
#include "armature/ride/internal/node/node_core.hpp"

namespace armature::ride::internal {

/// What a message does: it goes to a service, the directory, the peer that it came from, or back.
/// @thread the node's, but for what says otherwise
class Dispatcher {
 public:
  Dispatcher(NodeCore& core, const HostedServices& services, const AccessControl& access)
      : core_(core), services_(services), access_(access), directory_(core, services, access) {}

  /// Executes it. Throws std::bad_alloc if there is no memory for that.
  void dispatch(Link& link, const Message& message);

  /// Whether a body that goes on in several messages is to be taken; its first message.
  /// @return why not
  /// @thread any, with the link's lock held
  std::optional<Refusal> refusal_of(const Link& link, const Message& first,
                                    const std::string& identity) const;

 private:
  using Call = DirectoryService::Question;

  void take_control(Link& link, const Message& message);
  void execute(Link& link, const Message& message, bool is_request);
  void run_service(Link& link, const Hosted& hosted, const Call& call, Decoder& parameters,
                   Holding& holding);
  void fail(Link& link, const Hosted& hosted, const Call& call, std::string_view what);
  std::optional<Refusal> refusal_of_operation(const Link& link, const Hosted& hosted,
                                              Number operation, const std::string& identity) const;

  NodeCore& core_;
  const HostedServices& services_;
  const AccessControl& access_;
  const DirectoryService directory_;
};

}  // namespace armature::ride::internal
