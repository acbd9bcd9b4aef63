// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/result.hpp"

namespace armature::platform {

/// Ports of UDP, both among them.
struct UdpPorts {
  int first;
  int last;
};

/// For sockets of libraries that receive at all addresses of the machine: from now on those of this
/// process at `ports` are given what comes by `interface`, such as `lo`, and nothing else.
/// @return how many there are; the error says why the kernel does not do it
/// @thread configuration only
base::Result<int> receive_only_by(const std::string& interface, UdpPorts ports);

}  // namespace armature::platform
