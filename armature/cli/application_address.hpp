// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/ride/transport.hpp"

namespace armature::cli {

/// Where an application runs that this process connects to.
struct ApplicationAddress {
  std::string address;
  std::string certificate = {};  ///< files in PEM form, for `tls://` and `wss://`
  std::string key = {};
  std::string authority = {};
  std::string tokens = {};  ///< a file, for `ws://` and `wss://`
};

/// Whether it has the scheme of one, and is no file.
bool is_address(const std::string& text);
bool is_encrypted(const ApplicationAddress& application);

/// Why it makes no sense together with its files; empty if it does.
std::string wrong_use(const ApplicationAddress& application);

/// What a node needs to reach it, beside TCP and Unix-domain sockets.
/// @param diagnostics  what is wrong with the files
std::vector<std::shared_ptr<ride::Transport>> transports_to(const ApplicationAddress& application,
                                                            base::Diagnostics& diagnostics);

}  // namespace armature::cli
