// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests of programs that connect.

#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "armature/platform/sockets/poller.hpp"
#include "armature/websocket/transport.hpp"

namespace armature::websocket::internal {

inline std::shared_ptr<Transport> transport_with(const Options& options) {
  base::Diagnostics diagnostics;
  auto transport = make_transport(options, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.to_text();
  return transport;
}

/// Establishes a connection to its end, and says what was in the way; empty: nothing.
inline std::string problem_of(ride::Connection& connection) {
  while (true) {
    const ride::Progress progress = connection.establish();
    if (progress == ride::Progress::kDone) return {};
    if (progress == ride::Progress::kGone) return connection.problem();
    auto poller = std::move(platform::Poller::make()).value();
    poller->add(connection.handle(), 0,
                {progress == ride::Progress::kWantRead, progress == ride::Progress::kWantWrite});
    while (poller->wait(base::Duration::max()).empty()) {
    }
  }
}

inline std::string problem_at(Transport& transport, const ride::Address& address) {
  const auto numeric = transport.look_up(address);
  if (!numeric) return numeric.error();
  auto connection = transport.connect(numeric.value());
  return connection ? problem_of(*connection.value()) : connection.error();
}

}  // namespace armature::websocket::internal
