// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "armature/ride/node.hpp"
#include "armature/ride/placeholder.hpp"
#include "armature/ride/service.hpp"

namespace armature::studio::internal {

/// The inspector of a run, for pages: what they ask of it is handed on unseen, and its answers
/// back. The run takes the studio for its user, so what a page may do is looked at here.
class Relay final : public ride::Service {
 public:
  /// @param name  as which pages know it, also in policies
  explicit Relay(std::string name);

  /// From now on it is the one at this address.
  /// @thread any but the node's own, as for those below
  void connect(const std::string& address);
  /// There is none.
  void disconnect();
  /// There is one, and it has been found.
  bool found() const;

 private:
  /// Asks with bodies that somebody else has encoded.
  class Inspector final : public ride::Placeholder {
   public:
    using Placeholder::ask;
    using Placeholder::Placeholder;
  };
  /// A run, as long as it can be asked.
  struct Connection {
    explicit Connection(const std::string& address);
    ride::Node node;
    Inspector inspector;
  };

  ride::Executed execute(ride::Number operation, ride::Decoder& parameters,
                         ride::Reply& reply) override;
  std::shared_ptr<Connection> connection() const;

  const std::string name_;
  mutable std::mutex mutex_;  ///< of the next
  std::shared_ptr<Connection> connection_;
};

}  // namespace armature::studio::internal
