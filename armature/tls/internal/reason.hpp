// SPDX-License-Identifier: Apache-2.0
#pragma once

// Why a connection was refused, as a person says it; at most some 90 letters, as many as a log line
// takes.

#include <string>

#include "armature/tls/internal/openssl.hpp"
#include "armature/tls/internal/socket_bio.hpp"

namespace armature::tls::internal {

/// What was wrong with the certificate of the other side.
struct Verdict {
  std::string dialled;  ///< the name or address that it has to be for; empty at who listens
  std::string reason;
};

/// Has the session look at the other side's certificate, and note what is wrong with it.
/// @param verdict  outlives the session
void note_verdict(SSL& ssl, Verdict& verdict);

/// False once something came that no handshake begins with.
bool may_speak_tls(const Wire& wire);

/// Why a handshake has failed, by the thread's queue of errors, which is empty then.
std::string why_refused(const Wire& wire, const Verdict& verdict);

/// Why a connection has ended whose handshake was done.
std::string why_ended(const Wire& wire, int error);

}  // namespace armature::tls::internal
