// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/ride/node.hpp"
#include "armature/ride/transport.hpp"

namespace armature::ride::internal {

/// By what a node can be reached and reach others: what its owner gave it, TCP and Unix sockets.
class Transports {
 public:
  explicit Transports(const NodeOptions& options);

  /// nullptr if there is none of this scheme.
  Transport* find(const std::string& scheme) const;

  /// An address and what it is reached by.
  struct Place {
    Transport* transport;
    Address address;
  };
  base::Result<Place> place_of(const std::string& text) const;
  /// Where a node may listen, looked up; the error says what would be unsafe there.
  base::Result<Place> place_to_listen(const std::string& text) const;

 private:
  const NodeOptions& options_;
  std::vector<std::shared_ptr<Transport>> all_;
};

}  // namespace armature::ride::internal
