// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "armature/base/diagnostic.hpp"
#include "armature/studio/server.hpp"

namespace armature::studio::internal {

/// The server for an application that runs at the address `options.file`. It starts and stops none.
/// @return nothing after an error: nobody is there, no application, or it refuses
std::unique_ptr<Server> make_elsewhere_server(const ServerOptions& options,
                                              base::Diagnostics& diagnostics);

}  // namespace armature::studio::internal
