// SPDX-License-Identifier: Apache-2.0
// SDO server and client with frames of anybody; and with each other, where what is written has to
// be read again.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <span>
#include <vector>

#include "drives/canopen/sdo_client.hpp"
#include "drives/canopen/sdo_server.hpp"

namespace {

using namespace armature;

constexpr canopen::NodeId kNode = 3;
constexpr canopen::Address kText{0x2000, 0};

void refuse(const char* what) {
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

canopen::ObjectDictionary make_dictionary() {
  canopen::ObjectDictionary dictionary;
  dictionary.add_bytes(
      {.address = kText, .name = "Text", .type = canopen::DataType::kVisibleString}, {});
  dictionary.add({.address = {0x2001, 0}, .name = "Number", .type = canopen::DataType::kInteger16});
  dictionary.add({.address = {0x2002, 1},
                  .name = "Constant",
                  .type = canopen::DataType::kUnsigned32,
                  .access = canopen::Access::kConstant});
  return dictionary;
}

can::Frame frame_of(std::uint32_t id, std::span<const std::uint8_t> bytes) {
  can::Frame frame = can::data_frame(id, bytes);
  return frame;
}

/// Eight bytes are a frame, with more or fewer at the end.
void feed(std::span<const std::uint8_t> input) {
  canopen::ObjectDictionary dictionary = make_dictionary();
  canopen::SdoServer server(kNode, dictionary);
  canopen::SdoClient client(kNode);
  static_cast<void>(client.begin_upload(kText, base::Time{}));
  base::Time now{};
  for (; !input.empty(); input = input.subspan(std::min<std::size_t>(8, input.size()))) {
    const auto bytes = input.first(std::min<std::size_t>(8, input.size()));
    now += std::chrono::milliseconds(bytes[0] * 10);
    const auto answer = server.take(frame_of(canopen::cob_id::sdo_request(kNode), bytes), now);
    if (answer && (answer->size != 8 || answer->id != canopen::cob_id::sdo_response(kNode))) {
      refuse("an answer is no SDO");
    }
    static_cast<void>(server.check(now));
    const auto next = client.take(frame_of(canopen::cob_id::sdo_response(kNode), bytes), now);
    if (next && (next->size != 8 || next->id != canopen::cob_id::sdo_request(kNode))) {
      refuse("a request is no SDO");
    }
    if (client.bytes().size() > 64 * 1024) refuse("the client has more than its memory");
    static_cast<void>(client.check(now));
    if (client.status() == canopen::SdoClient::Status::kBusy) continue;
    static_cast<void>((bytes[0] & 1) != 0 ? client.begin_upload(kText, now)
                                          : client.begin_download(kText, bytes, now));
  }
}

void exchange(canopen::SdoServer& server, canopen::SdoClient& client, can::Frame request) {
  std::optional<can::Frame> next = request;
  while (next) {
    const auto answer = server.take(*next, base::Time{});
    if (!answer) refuse("a request has no answer");
    next = client.take(*answer, base::Time{});
  }
  if (client.status() != canopen::SdoClient::Status::kDone) refuse("a transfer was aborted");
}

void write_and_read(std::span<const std::uint8_t> input) {
  canopen::ObjectDictionary dictionary = make_dictionary();
  canopen::SdoServer server(kNode, dictionary);
  canopen::SdoClient client(kNode);
  exchange(server, client, client.begin_download(kText, input, base::Time{}));
  exchange(server, client, client.begin_upload(kText, base::Time{}));
  if (!std::ranges::equal(client.bytes(), input)) refuse("another text was read");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span input(data, size);
  feed(input);
  write_and_read(input.first(std::min<std::size_t>(size, 60'000)));
  return 0;
}
