// SPDX-License-Identifier: Apache-2.0
#include "armature/tls/internal/reason.hpp"

#include <openssl/err.h>
#include <openssl/x509_vfy.h>

#include "armature/tls/internal/certificate.hpp"

namespace armature::tls::internal {
namespace {

/// `its certificate 'anna'`, or of the authority above it.
std::string name_of(const X509& certificate, int depth) {
  return (depth == 0 ? "its certificate '" : "its authority '") + subject_of(certificate) + "'";
}

std::string why_not_trusted(int error, const X509& certificate, int depth,
                            const std::string& dialled) {
  const std::string name = name_of(certificate, depth);
  switch (error) {
    case X509_V_ERR_CERT_HAS_EXPIRED:
      return name + " expired on " + text_of(X509_get0_notAfter(&certificate));
    case X509_V_ERR_CERT_NOT_YET_VALID:
      return name + " is valid only from " + text_of(X509_get0_notBefore(&certificate));
    case X509_V_ERR_DEPTH_ZERO_SELF_SIGNED_CERT:
      return name + " is signed by itself, not by the authority";
    case X509_V_ERR_SELF_SIGNED_CERT_IN_CHAIN:
      return name + " is not the one of this side";
    case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT:
    case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT_LOCALLY:
    case X509_V_ERR_UNABLE_TO_VERIFY_LEAF_SIGNATURE:
      return name + " is of another authority, '" + issuer_of(certificate) + "'";
    case X509_V_ERR_CERT_SIGNATURE_FAILURE:
      return name + " is not signed by the authority that it names";
    case X509_V_ERR_HOSTNAME_MISMATCH:
    case X509_V_ERR_IP_ADDRESS_MISMATCH: {
      const std::string names = names_of(certificate);
      return name + " is not for '" + dialled + "', but for " + (names.empty() ? "nothing" : names);
    }
    case X509_V_ERR_INVALID_PURPOSE:
      return name + (dialled.empty() ? " is not for clients" : " is not for servers") +
             " (extendedKeyUsage)";
    default:
      return name + ": " + X509_verify_cert_error_string(error);
  }
}

/// OpenSSL calls it for each certificate of the chain, and for what is wrong with it.
int look_at(int ok, X509_STORE_CTX* context) {
  const auto* const ssl =
      static_cast<SSL*>(X509_STORE_CTX_get_ex_data(context, SSL_get_ex_data_X509_STORE_CTX_idx()));
  auto& verdict = *static_cast<Verdict*>(SSL_get_app_data(ssl));
  const X509* const certificate = X509_STORE_CTX_get_current_cert(context);
  const int depth = X509_STORE_CTX_get_error_depth(context);
  if (certificate == nullptr) return ok;
  if (ok == 0) {
    const int error = X509_STORE_CTX_get_error(context);
    verdict.reason = why_not_trusted(error, *certificate, depth, verdict.dialled);
  } else if (depth == 0 && identity_of(*certificate).empty()) {
    X509_STORE_CTX_set_error(context, X509_V_ERR_APPLICATION_VERIFICATION);
    verdict.reason = "its certificate has no common name that a policy could name";
    return 0;
  }
  return ok;
}

std::string text_of(unsigned long error) {
  const char* const text = ERR_reason_error_string(error);
  return text != nullptr ? text : "OpenSSL does not say why";
}

/// What the other side says of this side's certificate, or of its handshake.
std::string why_it_refuses(unsigned long error) {
  switch (ERR_GET_REASON(error)) {
    case SSL_R_TLSV13_ALERT_CERTIFICATE_REQUIRED:
      return "it refuses peers without a certificate";
    case SSL_R_TLSV1_ALERT_UNKNOWN_CA:
      return "it refuses the certificate of this side: it is of another authority";
    case SSL_R_SSLV3_ALERT_CERTIFICATE_EXPIRED:
      return "it refuses the certificate of this side: it has expired";
    case SSL_R_SSLV3_ALERT_BAD_CERTIFICATE:
    case SSL_R_SSLV3_ALERT_CERTIFICATE_UNKNOWN:
    case SSL_R_SSLV3_ALERT_UNSUPPORTED_CERTIFICATE:
      return "it refuses the certificate of this side: " + text_of(error);
    case SSL_R_TLSV1_ALERT_PROTOCOL_VERSION:
      return "it does not speak TLS 1.3";
    default:
      return "it refuses: " + text_of(error);
  }
}

bool is_alert(unsigned long error) {
  return ERR_GET_LIB(error) == ERR_LIB_SSL && ERR_GET_REASON(error) >= SSL_AD_REASON_OFFSET;
}

unsigned long take_error() {
  const unsigned long first = ERR_get_error();
  ERR_clear_error();
  return first;
}

}  // namespace

bool may_speak_tls(const Wire& wire) {
  constexpr unsigned char kAlert = 21;
  constexpr unsigned char kHandshake = 22;
  return !wire.first || *wire.first == kAlert || *wire.first == kHandshake;
}

void note_verdict(SSL& ssl, Verdict& verdict) {
  SSL_set_app_data(&ssl, &verdict);
  SSL_set_verify(&ssl, SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT, look_at);
}

std::string why_refused(const Wire& wire, const Verdict& verdict) {
  const unsigned long error = take_error();
  if (!verdict.reason.empty()) return verdict.reason;
  if (!may_speak_tls(wire)) return "what it sent is not TLS";
  if (is_alert(error)) return why_it_refuses(error);
  if (wire.failed) return wire.socket->problem();
  if (wire.ended) return "it ended the connection before the handshake was done";
  switch (ERR_GET_REASON(error)) {
    case SSL_R_PEER_DID_NOT_RETURN_A_CERTIFICATE:
      return "it has no certificate";
    case SSL_R_UNSUPPORTED_PROTOCOL:
      return "it does not speak TLS 1.3";
    default:
      return "its handshake is wrong: " + text_of(error);
  }
}

std::string why_ended(const Wire& wire, int error) {
  const unsigned long queued = take_error();
  if (is_alert(queued)) return why_it_refuses(queued);
  if (error == SSL_ERROR_ZERO_RETURN) return "the other side has ended it";
  if (wire.ended || wire.failed) return wire.socket->problem();
  return "the data is not TLS: " + text_of(queued);
}

}  // namespace armature::tls::internal
