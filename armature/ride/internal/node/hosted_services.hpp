// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/ride/internal/directory.hpp"
#include "armature/ride/internal/publisher.hpp"
#include "armature/ride/service.hpp"

namespace armature::ride::internal {

class Link;

/// A service at its node.
struct Hosted {
  std::uint32_t identifier;
  std::string name;
  std::uint32_t digest;
  Service* service;  ///< none once it was removed

  const Interface& interface() const { return service->interface(); }
  Publisher& publisher() const;
  /// As the directory tells it.
  ComponentEntry entry() const;
};

/// The services of a node, by identifiers that are never given again.
/// @thread the node's, but for what says otherwise
class HostedServices {
 public:
  /// @param node  its name, for the error: the name or the service is taken
  base::Result<std::uint32_t> add(const std::string& node, std::string name, Service& service);
  /// @return the identifier that it had; 0: none
  std::uint32_t remove(Service& service);

  /// nullptr if there is none, or no more.
  const Hosted* find(std::uint32_t identifier) const;
  const Hosted* find(std::string_view name) const;
  std::vector<ComponentEntry> entries() const;
  /// While it is held none is added or removed: for `find` by another thread.
  /// @thread any
  [[nodiscard]] std::unique_lock<std::mutex> hold_still() const { return std::unique_lock(mutex_); }

  /// Ends all subscriptions of a connection.
  void unsubscribe(const Link& link) const;
  void unsubscribe_all() const;

 private:
  mutable std::mutex mutex_;  ///< to change `all_`, and to look at it in another thread
  std::deque<Hosted> all_;
};

}  // namespace armature::ride::internal
