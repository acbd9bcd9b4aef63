// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/tls/internal/openssl.hpp"

namespace armature::tls::internal {

/// The common name of a certificate, or else its first DNS name. Empty if it has neither, or one
/// that a policy could not name: printable ASCII without spaces is expected, at most 64 letters.
std::string identity_of(const X509& certificate);

/// Printable ASCII without spaces, at most 64 letters.
bool can_be_named(std::string_view name);

/// The names and addresses that it is for, whole, in its order.
std::vector<std::string> all_names_of(const X509& certificate);
/// The same to be read: `robot.example, 192.168.1.5`.
std::string names_of(const X509& certificate);

/// How a person knows it: its common name, or its whole subject.
std::string subject_of(const X509& certificate);
/// The same of who has signed it.
std::string issuer_of(const X509& certificate);

/// `2026-11-22 06:30 UTC`.
std::string text_of(const ASN1_TIME* time);

/// The certificates of a file in PEM form, in their order.
std::vector<CertificatePointer> read_certificates(const std::string& pem);

}  // namespace armature::tls::internal
