// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "armature/base/diagnostic.hpp"
#include "armature/tls/transport.hpp"

namespace armature::cli {

/// tls::make_transport, whose library and OpenSSL are loaded with it; nothing after an error.
std::shared_ptr<ride::Transport> load_tls(const tls::Options& files,
                                          base::Diagnostics& diagnostics);

}  // namespace armature::cli
