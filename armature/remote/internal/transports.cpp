// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/internal/transports.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "armature/base/near_name.hpp"

namespace armature::remote::internal {
namespace {

/// Pages come over the last two, and programs, too.
const std::vector<std::string> kTransports{"tcp", "unix", "tls", "ws", "wss"};

bool has_scheme(const document::Reference& address, const std::string& scheme) {
  return address.name.starts_with(scheme + ":");
}

/// An address to listen at, and what its transport needs beside it.
void check_address(const document::Reference& written, const document::Network& network,
                   const ride::NodeOptions& node, base::Diagnostics& diagnostics) {
  const auto parsed = ride::Address::parse(written.name);
  if (!parsed) return diagnostics.error(written.where, parsed.error());
  const ride::Address& address = parsed.value();
  if (const auto known = check_transport(address, kTransports); !known) {
    return diagnostics.error(written.where, known.error());
  }
  const bool pages = address.scheme == "ws" || address.scheme == "wss";
  if (address.scheme == "tls" &&
      (network.authority.name.empty() || network.certificate.name.empty())) {
    diagnostics.error(written.where, "'" + written.name + "' needs certificates",
                      "add tls: {certificate: ..., key: ..., authority: ...} to network");
  }
  if (address.scheme == "wss" && network.certificate.name.empty()) {
    diagnostics.error(written.where, "'" + written.name + "' needs a certificate",
                      "add tls: {certificate: ..., key: ...} to network");
  }
  if (pages && network.pages.name.empty()) {
    diagnostics.error(written.where, "'" + written.name + "' has no pages to serve",
                      "add pages: FOLDER to network");
  }
  for (const auto& transport : node.transports) {
    if (!pages || transport->scheme() != address.scheme || transport->safe(address)) continue;
    diagnostics.error(written.where,
                      "'" + written.name + "': pages are served to this machine only",
                      "listen at ws://127.0.0.1:8080 or ws://[::1]:8080, or at wss:// with tls: "
                      "{certificate: ..., key: ...}");
  }
}

/// Components that live where a certificate is shown, which somebody has to have signed.
void check_remote(const document::Document& document, base::Diagnostics& diagnostics) {
  if (!document.network.authority.name.empty()) return;
  for (const document::Component& each : document.components) {
    if (!has_scheme(each.remote, "wss")) continue;
    diagnostics.error(each.remote.where,
                      "'" + each.remote.name + "' needs an authority that signs what it shows",
                      "add tls: {authority: ...} to network");
  }
}

bool any_has_scheme(const document::Document& document,
                    const std::vector<document::Reference>& addresses, const std::string& scheme) {
  return std::ranges::any_of(addresses,
                             [&](const auto& each) { return has_scheme(each, scheme); }) ||
         std::ranges::any_of(document.components,
                             [&](const auto& each) { return has_scheme(each.remote, scheme); });
}

void add_web(const document::Network& network, const NetworkOptions& means, ride::NodeOptions& node,
             base::Diagnostics& diagnostics) {
  if (!means.web) return;
  base::Diagnostics found;
  if (auto transport = means.web(network, found)) node.transports.push_back(std::move(transport));
  for (base::Diagnostic each : found.all()) {
    if (each.where.file.empty()) each.where = network.pages.where;
    diagnostics.add(std::move(each));
  }
}

}  // namespace

base::Result<void> check_transport(const ride::Address& address,
                                   const std::vector<std::string>& known) {
  if (std::ranges::find(known, address.scheme) != known.end()) return {};
  return base::Error{"'" + address.text() + "' has the unknown transport '" + address.scheme +
                     "' (" + base::suggestion(address.scheme, known).text + ")"};
}

void set_transports(const document::Document& document,
                    const std::vector<document::Reference>& addresses, const NetworkOptions& means,
                    ride::NodeOptions& node, base::Diagnostics& diagnostics) {
  document::Network network = document.network;
  for (document::Reference* file :
       {&network.pages, &network.certificate, &network.key, &network.authority}) {
    if (!file->name.empty()) file->name = document::path_from(document, file->name);
  }
  if (!network.authority.name.empty()) {
    if (auto transport = means.tls(network, diagnostics)) {
      node.transports.push_back(std::move(transport));
    }
  }
  const bool has_files = !network.certificate.name.empty() || !network.authority.name.empty();
  if (has_files && any_has_scheme(document, addresses, "wss")) {
    document::Network encrypted = network;
    if (network.certificate.name.empty()) encrypted.pages.name.clear();
    add_web(encrypted, means, node, diagnostics);
  }
  if (!network.pages.name.empty() || any_has_scheme(document, addresses, "ws")) {
    for (document::Reference* file : {&network.certificate, &network.key, &network.authority}) {
      file->name.clear();
    }
    add_web(network, means, node, diagnostics);
  }
  check_remote(document, diagnostics);
  for (const document::Reference& each : addresses) {
    check_address(each, document.network, node, diagnostics);
  }
}

}  // namespace armature::remote::internal
