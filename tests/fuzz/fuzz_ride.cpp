// SPDX-License-Identifier: Apache-2.0
// Any bytes into the receiving side of a node: put together, decoded, dispatched. A bound on memory
// and time is libFuzzer's; afterwards the node still answers another.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "armature/ride/node.hpp"
#include "armature/ride/transport.hpp"

namespace armature::ride {
namespace {

struct Point {
  std::int16_t tag = 0;
  std::vector<double> values;
  std::string name;
};
bool decode(Decoder& from, Point& point) {
  return from.take(point.tag) && from.take(point.values) && from.take(point.name);
}

constexpr Declaration kDeclarations[] = {
    {"void a(Array<struct Point{short,Array<double>,String}>)"},
    {"String b(String,Array<bool>,Array<String>)"},
    {"int c(bool,char,long)"},
    {"event d{int}", Access::kRead},
};
constexpr Interface kEverything{"Everything", kDeclarations};

class Everything : public Service {
 public:
  Everything() : Service(kEverything) {}

 private:
  Executed execute(Number operation, Decoder& from, Reply& reply) override {
    std::vector<Point> points;
    std::string text;
    std::vector<std::uint8_t> flags;
    std::vector<std::string> names;
    bool on = false;
    char letter = 0;
    std::int64_t number = 0;
    if (operation == kDeclarations[0].number()) {
      return from.take(points) && from.ended() ? Executed::kDone : Executed::kMalformed;
    }
    if (operation == kDeclarations[1].number()) {
      if (!from.take(text) || !from.take_flags(flags) || !from.take(names) || !from.ended()) {
        return Executed::kMalformed;
      }
      reply.put(text);
      return Executed::kDone;
    }
    if (operation == kDeclarations[2].number()) {
      if (!from.take(on) || !from.take(letter) || !from.take(number) || !from.ended()) {
        return Executed::kMalformed;
      }
      if (on) throw Failure("as it was told to");
      auto kept = reply.keep();
      kept.put(std::int32_t{1});
      return Executed::kDone;
    }
    return Executed::kNoSuchOperation;
  }
};

class Client {
 public:
  explicit Client(const Address& address)
      : connection_(std::move(make_unix_transport()->connect(address)).value()) {
    while (connection_->establish() != Progress::kDone) {
    }
  }
  void send(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      std::size_t sent = 0;
      const Progress progress = connection_->send(bytes, sent);
      if (progress == Progress::kGone) return;
      if (progress == Progress::kDone) bytes = bytes.subspan(sent);
      drop_answers(base::Duration(1));
    }
  }
  void end() { connection_->shut_down(); }
  /// What it is sent is what it asked for.
  bool ping() {
    Body body;
    Encoder(body).put(Control{Code::kPing, 0, 0, 0, "?"});
    Body message;
    append_message(message, {}, Type::kControl, 0, body.bytes());
    send(message.bytes());
    return answered_ || drop_answers(std::chrono::seconds(5));
  }

 private:
  bool drop_answers(base::Duration limit) {
    std::byte room[4096];
    std::size_t size = 0;
    if (connection_->wait_and_receive(room, size, limit) != Progress::kDone) return false;
    answered_ = true;
    return true;
  }

  std::unique_ptr<Connection> connection_;
  bool answered_ = false;
};

struct Target {
  Target() {
    NodeOptions options;
    options.limits.body_bytes = 1 << 20;
    node = std::make_unique<Node>(options);
    address = node->listen("unix:/tmp/armature_fuzz_ride_" + std::to_string(std::random_device{}()))
                  .value();
    if (!node->add("everything", service)) std::abort();
  }

  Everything service;
  std::unique_ptr<Node> node;
  Address address;
};

}  // namespace
}  // namespace armature::ride

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace armature::ride;
  static Target target;
  const auto* const bytes = reinterpret_cast<const std::byte*>(data);
  Client client(target.address);
  client.send({bytes, size});
  client.end();
  // A node that has not yet noticed who has gone may send the next one away: it comes again.
  const auto latest = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  do {
    if (Client(target.address).ping()) return 0;
  } while (std::chrono::steady_clock::now() < latest);
  std::fputs("the node does not answer any more\n", stderr);
  std::abort();
}
