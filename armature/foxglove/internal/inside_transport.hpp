// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "armature/ride/transport.hpp"

namespace armature::foxglove::internal {

/// The way to a node of this process, by a connection that is there already. There is no second
/// one: it ends with the client for whom it was made.
class InsideTransport final : public ride::Transport {
 public:
  /// To connect to.
  static constexpr const char* kAddress = "inside://application:1";

  explicit InsideTransport(std::unique_ptr<ride::Connection> connection)
      : connection_(std::move(connection)) {}

  std::string scheme() const override { return "inside"; }
  bool safe(const ride::Address&) const override { return true; }
  base::Result<std::unique_ptr<ride::Listener>> listen(const ride::Address& address) override {
    return base::Error{"'" + address.text() + "': nobody can listen there"};
  }
  base::Result<std::unique_ptr<ride::Connection>> connect(const ride::Address& address) override {
    if (connection_ == nullptr) return base::Error{"'" + address.text() + "' has gone"};
    return std::exchange(connection_, nullptr);
  }

 private:
  std::unique_ptr<ride::Connection> connection_;
};

}  // namespace armature::foxglove::internal
