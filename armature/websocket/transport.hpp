// SPDX-License-Identifier: Apache-2.0
#pragma once

// RIDE over WebSockets, for pages that the same address serves; docs/web.md says how to use it.

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/ride/transport.hpp"

namespace armature::websocket {

/// What is served, and what one page, and all together, may take.
struct Options {
  std::string pages = {};  ///< the folder whose files are served; nothing outside of it is
  /// Files in PEM form, with which the way to pages is encrypted: both, or none.
  std::string certificate = {};
  std::string key = {};
  /// A file that only this account can read: what lets in stays the same at the next start, so that
  /// pages that are open come back. Empty, or with a certificate: it is new at each start.
  std::string secrets = {};
  std::size_t connections = 32;  ///< at an address, those that only fetch files, too
  std::size_t frame_bytes =
      64 * 1024;  ///< of a frame from a page; a larger one ends the connection
  /// Who takes nothing of what waits for it so long is disconnected.
  base::Duration time_to_take = std::chrono::seconds(30);
};

/// The transport `ws://127.0.0.1:8080`, for ride::NodeOptions::transports, or with a certificate
/// `wss://0.0.0.0:8443`. It listens for pages and does not connect. Without a certificate only
/// loopback addresses are safe, since nothing on the way is encrypted; with one, pages reach it by
/// the names that the certificate is for, and by no others.
/// Identity of the other side: `page`, for whoever had the address that `pages` tells.
class Transport : public ride::Transport {
 public:
  /// Addresses to open in a browser, one for each that is listened at. What is
  /// behind the `#` is a secret: it lets in.
  /// @thread any
  virtual std::vector<std::string> pages() const = 0;
};

/// @param diagnostics  why the folder cannot be served, and every mistake in the certificate's
/// files
/// @return none after an error
std::shared_ptr<Transport> make_transport(const Options& options, base::Diagnostics& diagnostics);

}  // namespace armature::websocket
