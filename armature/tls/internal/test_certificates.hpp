// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests: authorities, and certificates of every kind, made as they are needed.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <openssl/ec.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include "armature/tls/internal/openssl.hpp"
#include "armature/tls/transport.hpp"

namespace armature::tls::internal {

struct Wish {
  std::string common_name = "robot";
  std::string names = "IP:127.0.0.1,DNS:localhost";  ///< none: no extension
  std::string usage = {};                            ///< `clientAuth`, `serverAuth`; none: any
  long from_s = -3600;                               ///< seconds from now
  long until_s = 3600;
  bool authority = false;
};

struct Issued {
  CertificatePointer certificate;
  KeyPointer key;
};

inline void add_extension(X509* certificate, X509* issuer, int kind, const std::string& value) {
  X509V3_CTX context{};
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  X509_EXTENSION* const made = X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str());
  ASSERT_NE(made, nullptr) << value;
  X509_add_ext(certificate, made, -1);
  X509_EXTENSION_free(made);
}

/// @param issuer  none: signed by itself
inline Issued issue(const Wish& wish, const Issued* issuer) {
  static std::int64_t serial = 0;
  Issued made{CertificatePointer(X509_new()), KeyPointer(EVP_EC_gen("P-256"))};
  X509* const certificate = made.certificate.get();
  X509_set_version(certificate, X509_VERSION_3);
  ASN1_INTEGER_set_int64(X509_get_serialNumber(certificate), ++serial);
  X509_gmtime_adj(X509_getm_notBefore(certificate), wish.from_s);
  X509_gmtime_adj(X509_getm_notAfter(certificate), wish.until_s);
  X509_set_pubkey(certificate, made.key.get());
  if (!wish.common_name.empty()) {
    X509_NAME_add_entry_by_txt(X509_get_subject_name(certificate), "CN", MBSTRING_UTF8,
                               reinterpret_cast<const unsigned char*>(wish.common_name.data()),
                               static_cast<int>(wish.common_name.size()), -1, 0);
  }
  X509* const signer = issuer != nullptr ? issuer->certificate.get() : certificate;
  X509_set_issuer_name(certificate, X509_get_subject_name(signer));
  add_extension(certificate, signer, NID_basic_constraints,
                wish.authority ? "critical,CA:TRUE" : "CA:FALSE");
  if (!wish.names.empty()) add_extension(certificate, signer, NID_subject_alt_name, wish.names);
  if (!wish.usage.empty()) add_extension(certificate, signer, NID_ext_key_usage, wish.usage);
  X509_sign(certificate, issuer != nullptr ? issuer->key.get() : made.key.get(), EVP_sha256());
  return made;
}

inline Issued make_authority(const std::string& name = "test authority") {
  return issue({.common_name = name, .names = "", .authority = true}, nullptr);
}

/// A folder of files in PEM form that goes with the test.
class Folder {
 public:
  Folder() {
    std::random_device random;
    path_ = std::filesystem::path(::testing::TempDir()) /
            ("tls_" + std::to_string(random()) + "_" + std::to_string(random()));
    std::filesystem::create_directory(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path_); }

  std::string path(const std::string& name) const { return path_ / name; }

  std::string write(const std::string& name, const X509* certificate) const {
    const BioPointer file(BIO_new_file(path(name).c_str(), "w"));
    PEM_write_bio_X509(file.get(), certificate);
    return path(name);
  }
  std::string write(const std::string& name, const EVP_PKEY* key,
                    const char* password = nullptr) const {
    const BioPointer file(BIO_new_file(path(name).c_str(), "w"));
    PEM_write_bio_PKCS8PrivateKey(file.get(), key,
                                  password != nullptr ? EVP_aes_256_cbc() : nullptr, password,
                                  password != nullptr ? 4 : 0, nullptr, nullptr);
    std::filesystem::permissions(
        path(name), std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    return path(name);
  }
  /// All that a side needs.
  Options write(const std::string& name, const Issued& own, const Issued& authority) const {
    return {write(name + ".pem", own.certificate.get()), write(name + ".key", own.key.get()),
            write(name + ".authority.pem", authority.certificate.get())};
  }

 private:
  std::filesystem::path path_;
};

inline std::unique_ptr<ride::Transport> transport_of(const Options& options) {
  base::Diagnostics diagnostics;
  auto made = make_transport(options, diagnostics);
  EXPECT_TRUE(diagnostics.empty()) << diagnostics.to_text();
  return made;
}

}  // namespace armature::tls::internal
