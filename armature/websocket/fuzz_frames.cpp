// SPDX-License-Identifier: Apache-2.0
// What a server sends is the same payload, the same end and the same problem, whether it comes at
// once or byte by byte; the head of an answer opens a WebSocket only with the right key.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "armature/websocket/internal/handshake.hpp"
#include "armature/websocket/internal/unframer.hpp"

namespace {

struct Taken {
  std::vector<std::byte> payload;
  bool ended = false;
  std::string reason;
  std::string problem;

  bool operator==(const Taken&) const = default;
};

Taken take(std::span<const std::byte> bytes, std::size_t at_once) {
  armature::websocket::internal::Unframer unframer;
  Taken taken;
  while (!bytes.empty()) {
    const std::size_t count = std::min(at_once, bytes.size());
    std::vector<std::byte> part(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
    part.resize(unframer.unframe(part));
    taken.payload.insert(taken.payload.end(), part.begin(), part.end());
    bytes = bytes.subspan(count);
  }
  taken.ended = unframer.ended();
  taken.reason = unframer.reason();
  taken.problem = unframer.problem();
  return taken;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
  const std::string_view head(reinterpret_cast<const char*>(data), size);
  // Nobody finds the answer to this key by chance.
  const bool opened =
      armature::websocket::internal::problem_of(head, "dGhlIHNhbXBsZSBub25jZQ==").empty() &&
      head.find("s3pPLMBiTxaQ9kYGzzhZRbK+xOo=") == std::string_view::npos;
  if (!opened && take(bytes, size) == take(bytes, 1)) return 0;
  std::fprintf(stderr,
               opened ? "a wrong key opens\n" : "the division of frames changes what comes\n");
  std::abort();
}
