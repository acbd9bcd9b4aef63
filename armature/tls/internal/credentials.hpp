// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/diagnostic.hpp"
#include "armature/tls/internal/openssl.hpp"
#include "armature/tls/transport.hpp"

namespace armature::tls::internal {

/// What all connections have in common: TLS 1.3, both certificates required, no session is taken up
/// again, so that each connection proves anew who it is.
/// @param diagnostics  every mistake in the files
/// @return none after an error
ContextPointer make_context(const Options& options, base::Diagnostics& diagnostics);
/// The same of a side that proves nothing itself, and only connects.
ContextPointer make_context_without_own(const std::string& authority,
                                        base::Diagnostics& diagnostics);

}  // namespace armature::tls::internal
