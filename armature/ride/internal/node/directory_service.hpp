// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "armature/ride/internal/link.hpp"
#include "armature/ride/internal/node/access_control.hpp"
#include "armature/ride/internal/node/hosted_services.hpp"
#include "armature/ride/internal/node/node_core.hpp"

namespace armature::ride::internal {

/// The component 0 of a node: tells which others there are, and begins and ends subscriptions to
/// their events.
/// @thread the node's
class DirectoryService {
 public:
  DirectoryService(NodeCore& core, const HostedServices& services, const AccessControl& access)
      : core_(core), services_(services), access_(access) {}

  /// A message for it, and what stands at the beginning of its body.
  struct Question {
    const Message& message;
    Number operation;
    std::uint32_t call;  ///< 0: a command, which nobody waits for
    bool is_request;
  };
  void execute(Link& link, const Question& question, Decoder& parameters) const;

 private:
  /// What a subscriber chooses.
  struct Wish {
    std::int32_t component = 0;
    Number event = 0;
    std::int32_t subscription = 0;
  };

  std::int32_t subscribe(Link& link, const Wish& wish) const;
  std::int32_t subscribe(Link& link, const Hosted& hosted, Number event,
                         std::uint32_t subscription) const;
  std::int32_t unsubscribe(Link& link, std::int32_t subscription) const;
  Code add_queue(Link& link, std::shared_ptr<EventQueue> queue) const;
  std::int32_t refuse(const Link& link, Code code, std::string_view why) const;

  NodeCore& core_;
  const HostedServices& services_;
  const AccessControl& access_;
};

}  // namespace armature::ride::internal
