// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace armature::websocket::internal {

/// What a browser says of a request, in its headers.
struct Visitor {
  std::string host = {};
  std::string origin = {};
  std::string authorization = {};
  std::string cookie = {};
};

/// By which names an address is reached.
struct Names {
  std::vector<std::string> hosts = {"127.0.0.1", "localhost", "[::1]"};  ///< as browsers write them
  std::uint16_t port = 0;
  bool encrypted = false;
};

/// Who may come in at one address: whoever reached it by its own name, from a page of its own, with
/// its token or the cookie that was given for it.
/// @thread any
class Entry {
 public:
  /// @param token, pass  secrets of as many bits as a key has, different ones
  Entry(const Names& names, std::string token, std::string pass);

  /// The name by which the address was reached is one of its own: no page elsewhere has had a name
  /// server point its own name here.
  bool knows_host(const Visitor& visitor) const;
  /// The page that asks came from here. Programs that send no Origin are not let in either.
  bool is_own_page(const Visitor& visitor) const;
  bool has_token(const Visitor& visitor) const;  ///< `Authorization: Bearer TOKEN`
  bool has_pass(const Visitor& visitor) const;   ///< the cookie

  const std::string& token() const { return token_; }
  /// Where the first page is, by the first of its names or `preferred` if that is one of them. It
  /// has the token.
  std::string url(const std::string& preferred) const;
  /// Likewise for sockets, without a token: `ws://127.0.0.1:8080`.
  std::string socket_url(const std::string& preferred) const;
  /// What the token is exchanged for: no script can read it, no other site sends it.
  std::string cookie() const;
  /// The sources that pages of this address may use.
  std::string content_policy() const;

 private:
  const std::string& shown_host(const std::string& preferred) const;

  const Names names_;
  const std::string port_;  ///< `:8080`; nothing if browsers leave it out
  const std::string token_;
  const std::string pass_;
};

/// Takes as long wherever the texts differ.
bool is_same_secret(std::string_view given, std::string_view secret);

}  // namespace armature::websocket::internal
