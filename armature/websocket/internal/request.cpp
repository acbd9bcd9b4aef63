// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/internal/request.hpp"

#include <optional>
#include <vector>

namespace armature::websocket::internal {
namespace {

std::string header(lws* request, lws_token_indexes which) {
  const int size = lws_hdr_total_length(request, which);
  if (size <= 0) return {};
  std::string text(static_cast<std::size_t>(size) + 1, '\0');
  const int copied = lws_hdr_copy(request, text.data(), static_cast<int>(text.size()), which);
  text.resize(copied < 0 ? 0 : static_cast<std::size_t>(copied));
  return text;
}

constexpr std::size_t kMostHeaderBytes = 1024;
constexpr int kEnd = -1;  ///< of the connection

}  // namespace

Visitor visitor_of(lws* request) {
  return {header(request, WSI_TOKEN_HOST), header(request, WSI_TOKEN_ORIGIN),
          header(request, WSI_TOKEN_HTTP_AUTHORIZATION), header(request, WSI_TOKEN_HTTP_COOKIE)};
}

std::string path_of(lws* request) { return header(request, WSI_TOKEN_GET_URI); }

int answer(lws* request, unsigned status, const std::string& cookie) {
  std::vector<unsigned char> room(LWS_PRE + kMostHeaderBytes);
  unsigned char* const begin = room.data() + LWS_PRE;
  unsigned char* at = begin;
  unsigned char* const end = room.data() + room.size();
  if (lws_add_http_common_headers(request, status, nullptr, 0, &at, end) != 0) return kEnd;
  if (!cookie.empty()) {
    const auto* const name = reinterpret_cast<const unsigned char*>("set-cookie:");
    const auto* const value = reinterpret_cast<const unsigned char*>(cookie.data());
    const int size = static_cast<int>(cookie.size());
    if (lws_add_http_header_by_name(request, name, value, size, &at, end) != 0) return kEnd;
  }
  [[maybe_unused]] const int written = lws_finalize_write_http_header(request, begin, &at, end);
  return kEnd;
}

int answer(lws* request, const Page& page) {
  const int served = lws_serve_http_file(request, page.file.c_str(), page.type.c_str(), nullptr, 0);
  if (served < 0) return kEnd;
  return served > 0 && lws_http_transaction_completed(request) != 0 ? kEnd : 0;
}

int answer_request(lws* request, std::string_view path, const Entry& entry, const Pages& pages) {
  const Visitor visitor = visitor_of(request);
  if (!entry.knows_host(visitor)) return answer(request, HTTP_STATUS_FORBIDDEN);
  if (lws_hdr_total_length(request, WSI_TOKEN_POST_URI) > 0) {
    if (path != "/token") return answer(request, HTTP_STATUS_NOT_FOUND);
    const bool good = entry.is_own_page(visitor) && entry.has_token(visitor);
    return good ? answer(request, HTTP_STATUS_NO_CONTENT, entry.cookie())
                : answer(request, HTTP_STATUS_FORBIDDEN);
  }
  if (lws_hdr_total_length(request, WSI_TOKEN_GET_URI) <= 0) {
    return answer(request, HTTP_STATUS_METHOD_NOT_ALLOWED);
  }
  const std::optional<Page> page = pages.find(path);
  return page ? answer(request, *page) : answer(request, HTTP_STATUS_NOT_FOUND);
}

}  // namespace armature::websocket::internal
