// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/internal/handshake.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include <libwebsockets.h>

namespace armature::websocket::internal {
namespace {

constexpr std::string_view kLineEnd = "\r\n";
/// What others have written is not to command a terminal, nor to fill a log.
constexpr std::size_t kMostShown = 40;

std::string shown_text(std::string_view text) {
  std::string result(text.substr(0, kMostShown));
  std::ranges::replace_if(
      result, [](unsigned char letter) { return letter < 0x20 || letter > 0x7e; }, '?');
  return text.size() > kMostShown ? result + "..." : result;
}

bool is_same_word(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

/// Of a header's first line of that name.
std::optional<std::string_view> header_in(std::string_view head, std::string_view name) {
  while (!head.empty()) {
    const std::size_t end = std::min(head.find(kLineEnd), head.size());
    const std::string_view line = head.substr(0, end);
    const std::size_t colon = line.find(':');
    if (colon != std::string_view::npos && is_same_word(line.substr(0, colon), name)) {
      return trimmed(line.substr(colon + 1));
    }
    head.remove_prefix(std::min(end + kLineEnd.size(), head.size()));
  }
  return std::nullopt;
}

std::string accept_for(const std::string& key) {
  const std::string text = key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";
  std::array<unsigned char, 20> digest{};
  lws_SHA1(reinterpret_cast<const unsigned char*>(text.data()), text.size(), digest.data());
  return base64({reinterpret_cast<const char*>(digest.data()), digest.size()});
}

/// `HTTP/1.1 404 Not Found`
std::string problem_of_status(std::string_view line) {
  constexpr std::string_view kVersion = "HTTP/1.1 ";
  if (!line.starts_with(kHttp) || line.size() < kVersion.size()) {
    return "no WebSocket is there: what it sent is no answer of HTTP";
  }
  const std::string_view status = line.substr(kVersion.size());
  if (line.starts_with(kVersion) && status.starts_with("101")) return {};
  if (status.starts_with("403") || status.starts_with("401")) {
    return "it lets this side not in (" + std::string(status.substr(0, 3)) +
           "): it expects its token, or a certificate of its authority";
  }
  return "no WebSocket is there: it answered '" + shown_text(status) + "'";
}

}  // namespace

std::string base64(std::string_view bytes) {
  constexpr std::size_t kSpare = 8;  // which the library wants behind the text
  std::string text((bytes.size() + 2) / 3 * 4 + kSpare, '\0');
  const int size = lws_b64_encode_string(bytes.data(), static_cast<int>(bytes.size()), text.data(),
                                         static_cast<int>(text.size()));
  text.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
  return text;
}

Door door_of(const std::string& host, std::uint16_t port, bool encrypted) {
  const std::uint16_t usual = encrypted ? 443 : 80;
  std::string name = host.find(':') == std::string::npos ? host : "[" + host + "]";
  std::ranges::transform(name, name.begin(),
                         [](unsigned char letter) { return std::tolower(letter); });
  if (port != usual) name += ":" + std::to_string(port);
  return {name, (encrypted ? "https://" : "http://") + name, {}};
}

std::string request_of(const Door& door, const std::string& key) {
  return "GET / HTTP/1.1\r\nHost: " + door.host +
         "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nOrigin: " + door.origin +
         "\r\nSec-WebSocket-Key: " + key + "\r\nSec-WebSocket-Version: 13" +
         "\r\nSec-WebSocket-Protocol: " + std::string(kSubprotocol) +
         (door.token.empty() ? "" : "\r\nAuthorization: Bearer " + door.token) + "\r\n\r\n";
}

std::string problem_of(std::string_view head, const std::string& key) {
  const std::string_view line = head.substr(0, head.find(kLineEnd));
  if (std::string problem = problem_of_status(line); !problem.empty()) return problem;
  if (!is_same_word(header_in(head, "Upgrade").value_or(""), "websocket")) {
    return "no WebSocket is there: it changes to another protocol";
  }
  if (header_in(head, "Sec-WebSocket-Accept") != accept_for(key)) {
    return "its answer is to another request (Sec-WebSocket-Accept)";
  }
  const std::string_view protocol = header_in(head, "Sec-WebSocket-Protocol").value_or("");
  if (protocol != kSubprotocol) {
    return "the WebSocket there has the subprotocol '" + shown_text(protocol) + "', expected '" +
           std::string(kSubprotocol) + "'";
  }
  if (header_in(head, "Sec-WebSocket-Extensions")) {
    return "it uses an extension that this side has not offered";
  }
  return {};
}

}  // namespace armature::websocket::internal
