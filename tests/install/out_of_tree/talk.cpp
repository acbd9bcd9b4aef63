// SPDX-License-Identifier: Apache-2.0
// Calls a generated service by its generated placeholder, with nothing but the package.
#include <cstdio>

#include "armature/ride/node.hpp"
#include "talk_client.hpp"
#include "talk_service.hpp"

namespace {

class Letters final : public talk::TalkService {
 public:
  std::int32_t say(const std::string& what) override {
    return static_cast<std::int32_t>(what.size());
  }
};

}  // namespace

int main() {
  Letters service;
  armature::ride::Node node;
  const auto address = node.listen("tcp://127.0.0.1:0");
  if (!address || !node.add("letters", service)) return 1;
  armature::ride::Node client;
  armature::ride::Peer& peer = client.connect(address.value().text());
  if (!peer.wait_until_connected(std::chrono::seconds(20))) return 1;
  talk::TalkPlaceholder letters(peer, "letters");
  const auto said = letters.say("hello", {.deadline = std::chrono::seconds(20), .priority = {}});
  if (!said.ok()) std::fprintf(stderr, "%s\n", said.error().c_str());
  return said.ok() && said.value() == 5 ? 0 : 1;
}
