// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "armature/base/result.hpp"

namespace armature::ride {

/// Where a node listens: `tcp://127.0.0.1:4242`, `tcp://[::1]:4242`, `unix:/run/robot.sock`,
/// `tls://robot.example:4243`.
struct Address {
  std::string scheme;
  std::string host;        ///< of `unix` the path of the socket file
  std::uint16_t port = 0;  ///< 0: any that is free, of `unix` always 0
  std::string name = {};   ///< of a host that was looked up, where its name has to be proven

  std::string text() const;
  /// The error says what was expected.
  static base::Result<Address> parse(std::string_view text);

  friend bool operator==(const Address&, const Address&) = default;
};

}  // namespace armature::ride
