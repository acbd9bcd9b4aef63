// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/internal/entry.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace armature::websocket::internal {
namespace {

/// The cookie's name has the port, since browsers give all ports of a host the same cookies.
std::string cookie_name(std::uint16_t port) { return "armature-" + std::to_string(port); }

/// Browsers leave out the usual one.
std::string shown_port(const Names& names) {
  const std::uint16_t usual = names.encrypted ? 443 : 80;
  return names.port == usual ? std::string() : ":" + std::to_string(names.port);
}

std::string scheme(const Names& names) { return names.encrypted ? "https://" : "http://"; }

}  // namespace

bool is_same_secret(std::string_view given, std::string_view secret) {
  if (given.size() != secret.size()) return false;
  unsigned char difference = 0;
  for (std::size_t i = 0; i < given.size(); ++i) {
    difference = static_cast<unsigned char>(difference | (given[i] ^ secret[i]));
  }
  return difference == 0;
}

Entry::Entry(const Names& names, std::string token, std::string pass)
    : names_(names), port_(shown_port(names)), token_(std::move(token)), pass_(std::move(pass)) {}

bool Entry::knows_host(const Visitor& visitor) const {
  return std::ranges::any_of(names_.hosts,
                             [&](const std::string& host) { return visitor.host == host + port_; });
}

bool Entry::is_own_page(const Visitor& visitor) const {
  return knows_host(visitor) && visitor.origin == scheme(names_) + visitor.host;
}

bool Entry::has_token(const Visitor& visitor) const {
  constexpr std::string_view kScheme = "Bearer ";
  const std::string_view given = visitor.authorization;
  return given.starts_with(kScheme) && is_same_secret(given.substr(kScheme.size()), token_);
}

bool Entry::has_pass(const Visitor& visitor) const {
  const std::string begin = cookie_name(names_.port) + "=";
  std::string_view left = visitor.cookie;
  while (!left.empty()) {
    const std::size_t end = std::min(left.find(';'), left.size());
    std::string_view one = left.substr(0, end);
    one.remove_prefix(std::min(one.find_first_not_of(' '), one.size()));
    if (one.starts_with(begin) && is_same_secret(one.substr(begin.size()), pass_)) return true;
    left.remove_prefix(std::min(end + 1, left.size()));
  }
  return false;
}

std::string Entry::cookie() const {
  return cookie_name(names_.port) + "=" + pass_ + "; HttpOnly; SameSite=Strict; Path=/" +
         (names_.encrypted ? "; Secure" : "");
}

const std::string& Entry::shown_host(const std::string& preferred) const {
  const bool known = std::ranges::count(names_.hosts, preferred) > 0;
  return known ? preferred : names_.hosts.front();
}

std::string Entry::url(const std::string& preferred) const {
  return scheme(names_) + shown_host(preferred) + port_ + "/#" + token_;
}

std::string Entry::socket_url(const std::string& preferred) const {
  return (names_.encrypted ? "wss://" : "ws://") + shown_host(preferred) + port_;
}

std::string Entry::content_policy() const {
  // Not every browser takes sockets without encryption for those of the page's own address.
  const std::string sockets =
      names_.encrypted ? "" : " ws://127.0.0.1" + port_ + " ws://localhost" + port_;
  return "default-src 'self'; connect-src 'self'" + sockets +
         "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

}  // namespace armature::websocket::internal
