// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"

struct ssl_st;  ///< OpenSSL's session

namespace armature::tls {

/// Files in PEM form by which a server proves who it is to those that have no certificate
/// themselves, such as browsers.
struct ServerFiles {
  std::string certificate;  ///< those of authorities between it and the root follow it
  std::string key;          ///< its private key, without a password
};

/// Looks at files that another library is going to serve with.
/// @param diagnostics  every mistake in them: missing, no PEM, expired, a key that does not fit, no
///   name; warned of: a key that others may read
/// @return the names and addresses that the certificate is for, in its order, without those that
///   stand for many (`*.lab`); empty after an error
/// @thread any
std::vector<std::string> check_server_files(const ServerFiles& files,
                                            base::Diagnostics& diagnostics);

/// Who the other side of a session of another library has proven to be, as over `tls://`; empty if
/// it has shown no certificate that was found good.
/// @thread that of the session
std::string proven_identity(const ssl_st* session);

}  // namespace armature::tls
