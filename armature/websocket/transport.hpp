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
#include "armature/websocket/messages.hpp"

namespace armature::websocket {

/// What is served, and what one page, and all together, may take.
struct Options {
  /// The folder whose files are served; nothing outside of it is. Empty: it only connects.
  std::string pages = {};
  /// Files in PEM form, with which the way to pages is encrypted, and which this side shows where
  /// it connects: both, or none.
  std::string certificate = {};
  std::string key = {};
  /// In PEM form those who sign: the servers to connect to, and programs that come with a
  /// certificate. Empty: it connects to nobody over `wss://`, and knows pages alone.
  std::string authority = {};
  /// A file of what lets this side in elsewhere: addresses as other applications tell them, with
  /// their tokens, one a line; empty: none.
  std::string tokens = {};
  /// A file that only this account can read: what lets in stays the same at the next start, so that
  /// pages that are open come back. Empty, or with a certificate: it is new at each start.
  std::string secrets = {};
  std::size_t connections = 32;  ///< at an address, those that only fetch files, too
  std::size_t frame_bytes =
      64 * 1024;  ///< of a frame from a page; a larger one ends the connection
  /// Who speaks another protocol there, too; none: nobody.
  std::shared_ptr<Messages> messages = {};
  /// Who takes nothing of what waits for it so long is disconnected.
  base::Duration time_to_take = std::chrono::seconds(30);
};

/// The transport `ws://127.0.0.1:8080`, for ride::NodeOptions::transports, or with a certificate or
/// an authority `wss://0.0.0.0:8443`. It listens for pages and programs, and connects to where
/// others do. Without a certificate only loopback addresses are safe, since nothing on the way is
/// encrypted; with one it is reached by the names that the certificate is for, and by no others.
/// Who connects checks that the certificate there is of the authority and for the name or the
/// address it has dialled.
/// Identity of who connected: `page`, for whoever had the address that `pages` tells; `NAME@tls`
/// for the common name of a certificate that the authority has signed. Of who listens: the common
/// name of its certificate.
class Transport : public ride::Transport {
 public:
  /// Addresses to open in a browser, one for each that is listened at. What is
  /// behind the `#` is a secret: it lets in.
  /// @thread any
  virtual std::vector<std::string> pages() const = 0;
};

/// @param diagnostics  why the folder cannot be served, and every mistake in the files of TLS and
/// of
///   tokens
/// @return none after an error
std::shared_ptr<Transport> make_transport(const Options& options, base::Diagnostics& diagnostics);

}  // namespace armature::websocket
