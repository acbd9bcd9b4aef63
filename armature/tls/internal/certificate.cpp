// SPDX-License-Identifier: Apache-2.0
#include "armature/tls/internal/certificate.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <string_view>

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

namespace armature::tls::internal {
namespace {

using NamesPointer = std::unique_ptr<GENERAL_NAMES, Free<GENERAL_NAMES_free>>;

std::string_view view_of(const ASN1_STRING* text) {
  return {reinterpret_cast<const char*>(ASN1_STRING_get0_data(text)),
          static_cast<std::size_t>(ASN1_STRING_length(text))};
}

/// What others have written into a certificate is not to command a terminal, nor to fill a log.
std::string shown(std::string_view text) {
  constexpr std::size_t kMostShown = 40;
  std::string result(text.substr(0, kMostShown));
  std::ranges::replace_if(
      result, [](char c) { return c < 0x20 || c > 0x7e; }, '?');
  return text.size() > kMostShown ? result + "..." : result;
}

std::string_view common_name_in(const X509_NAME* name) {
  const int at = X509_NAME_get_index_by_NID(name, NID_commonName, -1);
  if (at < 0) return {};
  return view_of(X509_NAME_ENTRY_get_data(X509_NAME_get_entry(name, at)));
}

std::string name_in(const X509_NAME* name) {
  if (const auto common = common_name_in(name); !common.empty()) return shown(common);
  std::array<char, 256> line{};
  X509_NAME_oneline(name, line.data(), line.size());
  return shown(line.data());
}

NamesPointer alternative_names(const X509& certificate) {
  return NamesPointer(static_cast<GENERAL_NAMES*>(
      X509_get_ext_d2i(&certificate, NID_subject_alt_name, nullptr, nullptr)));
}

std::string text_of_address(const ASN1_OCTET_STRING* address) {
  const unsigned char* const bytes = ASN1_STRING_get0_data(address);
  const int size = ASN1_STRING_length(address);
  std::array<char, 64> text{};
  if (size == 4) {
    std::snprintf(text.data(), text.size(), "%d.%d.%d.%d", bytes[0], bytes[1], bytes[2], bytes[3]);
    return text.data();
  }
  std::string result;
  for (int i = 0; i + 1 < size; i += 2) {
    std::snprintf(text.data(), text.size(), "%s%x", i == 0 ? "" : ":",
                  bytes[i] << 8 | bytes[i + 1]);
    result += text.data();
  }
  return result;
}

}  // namespace

bool can_be_named(std::string_view name) {
  constexpr std::size_t kMostLetters = 64;
  return !name.empty() && name.size() <= kMostLetters &&
         std::ranges::all_of(name, [](char c) { return c > 0x20 && c < 0x7f; });
}

std::string identity_of(const X509& certificate) {
  std::string_view name = common_name_in(X509_get_subject_name(&certificate));
  const NamesPointer names = alternative_names(certificate);
  for (int i = 0; name.empty() && i < sk_GENERAL_NAME_num(names.get()); ++i) {
    const GENERAL_NAME* const other = sk_GENERAL_NAME_value(names.get(), i);
    if (other->type == GEN_DNS) name = view_of(other->d.dNSName);
  }
  return can_be_named(name) ? std::string(name) : std::string();
}

std::vector<std::string> all_names_of(const X509& certificate) {
  const NamesPointer names = alternative_names(certificate);
  std::vector<std::string> all;
  for (int i = 0; i < sk_GENERAL_NAME_num(names.get()); ++i) {
    const GENERAL_NAME* const name = sk_GENERAL_NAME_value(names.get(), i);
    if (name->type == GEN_IPADD) all.push_back(text_of_address(name->d.iPAddress));
    if (name->type == GEN_DNS) all.emplace_back(view_of(name->d.dNSName));
  }
  return all;
}

std::string names_of(const X509& certificate) {
  std::string all;
  for (const std::string& name : all_names_of(certificate)) {
    all += all.empty() ? "" : ", ";
    all += shown(name);
  }
  return all;
}

std::string subject_of(const X509& certificate) {
  return name_in(X509_get_subject_name(&certificate));
}

std::string issuer_of(const X509& certificate) {
  return name_in(X509_get_issuer_name(&certificate));
}

std::string text_of(const ASN1_TIME* time) {
  std::tm parts{};
  if (ASN1_TIME_to_tm(time, &parts) != 1) return "an unreadable time";
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M UTC", &parts);
  return text.data();
}

std::vector<CertificatePointer> read_certificates(const std::string& pem) {
  const BioPointer file(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
  std::vector<CertificatePointer> all;
  while (X509* const next = PEM_read_bio_X509(file.get(), nullptr, nullptr, nullptr)) {
    all.emplace_back(next);
  }
  ERR_clear_error();
  return all;
}

}  // namespace armature::tls::internal
