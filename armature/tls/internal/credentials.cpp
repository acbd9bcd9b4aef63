// SPDX-License-Identifier: Apache-2.0
#include "armature/tls/internal/credentials.hpp"

#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include "armature/platform/file.hpp"
#include "armature/platform/sockets/stream_socket.hpp"
#include "armature/tls/internal/certificate.hpp"
#include "armature/tls/server_files.hpp"

namespace armature::tls::internal {
namespace {

using Certificates = std::vector<CertificatePointer>;

/// Reads the files and tells what is wrong with them.
class Files {
 public:
  explicit Files(base::Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// @param what  such as "the certificate"
  Certificates certificates(const std::string& path, const std::string& what) {
    const auto pem = read(path, what);
    if (!pem) return {};
    Certificates all = read_certificates(*pem);
    if (all.empty()) {
      wrong(path, what + " is not in PEM form: expected -----BEGIN CERTIFICATE-----",
            "openssl x509 -inform der -in FILE -out FILE.pem makes PEM of DER");
    }
    for (const auto& certificate : all) check_time(path, *certificate);
    return all;
  }

  KeyPointer key(const std::string& path) {
    const auto pem = read(path, "the key");
    if (!pem) return nullptr;
    warn_of_readers(path);
    bool asked_for_password = false;
    const auto note = [](char*, int, int, void* asked) {
      *static_cast<bool*>(asked) = true;
      return -1;  // Nobody sits there who could type it.
    };
    const BioPointer file(BIO_new_mem_buf(pem->data(), static_cast<int>(pem->size())));
    KeyPointer key(PEM_read_bio_PrivateKey(file.get(), nullptr, note, &asked_for_password));
    ERR_clear_error();
    if (asked_for_password) {
      wrong(path, "the key has a password, which cannot be typed when the robot starts",
            "openssl pkey -in FILE -out FILE.open removes it; chmod 600 FILE.open");
    } else if (!key) {
      wrong(path, "the key is not in PEM form: expected -----BEGIN PRIVATE KEY-----", "");
    }
    return key;
  }

  void check_pair(const ServerFiles& files, const X509& certificate, const EVP_PKEY& key) {
    if (X509_check_private_key(&certificate, &key) != 1) {
      ERR_clear_error();
      wrong(files.key, "the key does not fit the certificate " + files.certificate,
            "each certificate has a key of its own, made with it");
    }
  }

  void check_identity(const std::string& path, const X509& certificate) {
    if (!identity_of(certificate).empty()) return;
    wrong(path, "the certificate has no usable common name or DNS name",
          "a name is printable ASCII without spaces, at most 64 letters: -subj /CN=robot");
  }

  /// Browsers look at no common name.
  std::vector<std::string> own_names(const std::string& path, const X509& certificate) {
    std::vector<std::string> names;
    for (const std::string& name : all_names_of(certificate)) {
      if (!can_be_named(name) || name.front() == '*') continue;
      names.push_back(platform::shortest_address(name));
    }
    if (names.empty()) {
      wrong(path, "the certificate is for no name and no address by which a page could be reached",
            "-addext subjectAltName=DNS:robot.lab,IP:192.168.1.5");
    }
    return names;
  }

  void check_authority(const std::string& path, const X509& certificate) {
    if (X509_check_ca(const_cast<X509*>(&certificate)) != 0) return;
    wrong(path, "'" + subject_of(certificate) + "' is not an authority: it may not sign others",
          "an authority's certificate says CA:TRUE");
  }

 private:
  void wrong(const std::string& path, std::string message, std::string hint) {
    diagnostics_.error({path, 0, 0}, std::move(message), std::move(hint));
  }

  std::optional<std::string> read(const std::string& path, const std::string& what) {
    constexpr std::size_t kMost = 1 << 20;
    if (path.empty()) {
      wrong({}, "no file is given for " + what,
            "TLS needs a certificate, its key and an authority");
      return std::nullopt;
    }
    auto content = platform::read_file(path, kMost);
    if (content) return std::move(content).value();
    wrong(path, what + " cannot be read: " + content.error(), "");
    return std::nullopt;
  }

  void check_time(const std::string& path, const X509& certificate) {
    const std::string name = "the certificate '" + subject_of(certificate) + "'";
    if (X509_cmp_current_time(X509_get0_notAfter(&certificate)) < 0) {
      wrong(path, name + " expired on " + text_of(X509_get0_notAfter(&certificate)),
            "have the authority sign a new one");
    } else if (X509_cmp_current_time(X509_get0_notBefore(&certificate)) > 0) {
      wrong(path, name + " is valid only from " + text_of(X509_get0_notBefore(&certificate)),
            "check this machine's clock");
    }
  }

  void warn_of_readers(const std::string& path) {
    using std::filesystem::perms;
    std::error_code failed;
    const perms others = std::filesystem::status(path, failed).permissions() & perms::others_read;
    if (failed || others == perms::none) return;
    diagnostics_.warning({path, 0, 0}, "everyone on this machine may read the key", "chmod 600");
  }

  base::Diagnostics& diagnostics_;
};

/// Certificates behind the first lead from it to the authority.
bool use_own(SSL_CTX* context, const Certificates& chain, EVP_PKEY* key) {
  if (SSL_CTX_use_certificate(context, chain.front().get()) != 1) return false;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    if (SSL_CTX_add1_chain_cert(context, chain[i].get()) != 1) return false;
  }
  return SSL_CTX_use_PrivateKey(context, key) == 1;
}

/// Who connects is told which authorities there are.
bool use_authorities(SSL_CTX* context, const Certificates& authorities) {
  X509_STORE* const store = SSL_CTX_get_cert_store(context);
  for (const auto& authority : authorities) {
    if (X509_STORE_add_cert(store, authority.get()) != 1) return false;
    if (SSL_CTX_add_client_CA(context, authority.get()) != 1) return false;
  }
  return true;
}

void set_rules(SSL_CTX* context) {
  SSL_CTX_set_min_proto_version(context, TLS1_3_VERSION);
  SSL_CTX_set_verify(context, SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT, nullptr);
  SSL_CTX_set_session_cache_mode(context, SSL_SESS_CACHE_OFF);
  SSL_CTX_set_num_tickets(context, 0);
  // What waits to be sent grows and moves until it can be sent again.
  SSL_CTX_set_mode(context, SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER |
                                SSL_MODE_RELEASE_BUFFERS);
}

void tell_why_not(const std::string& path, base::Diagnostics& diagnostics) {
  const char* const reason = ERR_reason_error_string(ERR_get_error());
  diagnostics.error({path, 0, 0},
                    std::string("OpenSSL rejects the certificate: ") +
                        (reason != nullptr ? reason : "it does not say why"),
                    "RSA needs 2048 bits at least");
  ERR_clear_error();
}

}  // namespace

ContextPointer make_context(const Options& options, base::Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.error_count();
  Files files(diagnostics);
  const Certificates chain = files.certificates(options.certificate, "the certificate");
  const KeyPointer key = files.key(options.key);
  const Certificates authorities = files.certificates(options.authority, "the authority");
  if (!chain.empty()) files.check_identity(options.certificate, *chain.front());
  if (!chain.empty() && key)
    files.check_pair({options.certificate, options.key}, *chain.front(), *key);
  for (const auto& authority : authorities) files.check_authority(options.authority, *authority);
  if (diagnostics.error_count() != before) return nullptr;

  ContextPointer context(SSL_CTX_new(TLS_method()));
  if (context && use_own(context.get(), chain, key.get()) &&
      use_authorities(context.get(), authorities)) {
    set_rules(context.get());
    return context;
  }
  tell_why_not(options.certificate, diagnostics);
  return nullptr;
}

ContextPointer make_context_without_own(const std::string& authority,
                                        base::Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.error_count();
  Files files(diagnostics);
  const Certificates authorities = files.certificates(authority, "the authority");
  for (const auto& each : authorities) files.check_authority(authority, *each);
  if (diagnostics.error_count() != before) return nullptr;
  ContextPointer context(SSL_CTX_new(TLS_method()));
  if (context && use_authorities(context.get(), authorities)) {
    set_rules(context.get());
    return context;
  }
  tell_why_not(authority, diagnostics);
  return nullptr;
}

}  // namespace armature::tls::internal

namespace armature::tls {

std::vector<std::string> check_server_files(const ServerFiles& given,
                                            base::Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.error_count();
  internal::Files files(diagnostics);
  const auto chain = files.certificates(given.certificate, "the certificate");
  const auto key = files.key(given.key);
  if (!chain.empty() && key) files.check_pair(given, *chain.front(), *key);
  if (diagnostics.error_count() != before) return {};
  return files.own_names(given.certificate, *chain.front());
}

std::string proven_identity(const ssl_st* session) {
  if (session == nullptr || SSL_get_verify_result(session) != X509_V_OK) return {};
  const X509* const certificate = SSL_get0_peer_certificate(session);
  return certificate == nullptr ? std::string() : internal::identity_of(*certificate);
}

}  // namespace armature::tls
