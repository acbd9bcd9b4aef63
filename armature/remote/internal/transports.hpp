// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/result.hpp"
#include "armature/document/document.hpp"
#include "armature/remote/network.hpp"
#include "armature/ride/address.hpp"
#include "armature/ride/node.hpp"

namespace armature::remote::internal {

/// The error names the transports that there are.
base::Result<void> check_transport(const ride::Address& address,
                                   const std::vector<std::string>& known);

/// Gives the node the transports that the document's network needs.
/// @param addresses  where it is going to listen
/// @param diagnostics  what is wrong with the addresses, or missing beside them
void set_transports(const document::Document& document,
                    const std::vector<document::Reference>& addresses, const NetworkOptions& means,
                    ride::NodeOptions& node, base::Diagnostics& diagnostics);

}  // namespace armature::remote::internal
