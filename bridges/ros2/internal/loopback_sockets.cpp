// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/internal/loopback_sockets.hpp"

#include "armature/platform/sockets/received_by.hpp"

namespace armature::ros2::internal {

std::string keep_on_loopback(int domain) {
  // The ports of a domain, as the specification of RTPS counts them (section 9.6.1).
  constexpr int kFirstPort = 7400;
  constexpr int kPortsOfADomain = 250;
  const int first = kFirstPort + domain * kPortsOfADomain;
  const auto kept = platform::receive_only_by("lo", {first, first + kPortsOfADomain - 1});
  if (kept && kept.value() > 0) return {};
  return "DDS cannot be kept on this machine: " + (kept ? "it has no sockets" : kept.error());
}

}  // namespace armature::ros2::internal
