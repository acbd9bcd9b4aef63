// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include <libwebsockets.h>

#include "armature/websocket/internal/entry.hpp"
#include "armature/websocket/internal/pages.hpp"

namespace armature::websocket::internal {

/// What the library has parsed of the headers of a request.
Visitor visitor_of(lws* request);
/// Of a request for something, and so of one for a socket: `/foxglove/...`.
std::string path_of(lws* request);

// Answers to a request. Each returns what the library's callback is to return.

/// Without a body, and the end of the connection.
/// @param cookie  is set; empty: none
int answer(lws* request, unsigned status, const std::string& cookie = {});
int answer(lws* request, const Page& page);

/// Of a page, the token, or why not.
int answer_request(lws* request, std::string_view path, const Entry& entry, const Pages& pages);

}  // namespace armature::websocket::internal
