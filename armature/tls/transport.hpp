// SPDX-License-Identifier: Apache-2.0
#pragma once

// RIDE over TLS 1.3, where both sides prove who they are; docs/security.md says how to set it up.

#include <memory>
#include <string>

#include "armature/base/diagnostic.hpp"
#include "armature/ride/transport.hpp"

namespace armature::tls {

/// Files in PEM form.
struct Options {
  std::string
      certificate;        ///< of this side; those of authorities between it and the root follow it
  std::string key;        ///< its private key, without a password
  std::string authority;  ///< the authorities whose certificates are taken from others
};

/// The transport `tls://host:port`, for ride::NodeOptions::transports. Every connection needs a
/// certificate of both sides that the authority has signed. Who connects also checks that the
/// certificate is for the name or the address it has dialled. Identity of the other side: the
/// common name of its certificate, without one its first DNS name.
/// @param diagnostics  every mistake in the files: missing, no PEM, expired, a key that does not
///   fit; warned of: a key that others may read
/// @return none after an error
/// @thread any; the files are read here and not again
std::unique_ptr<ride::Transport> make_transport(const Options& options,
                                                base::Diagnostics& diagnostics);

/// The same for who only connects. Certificate and key may both be left out, for servers that ask
/// for none.
std::unique_ptr<ride::Transport> make_client_transport(const Options& options,
                                                       base::Diagnostics& diagnostics);

}  // namespace armature::tls
