// SPDX-License-Identifier: Apache-2.0
#include <thread>

#include "benchmarks/bare_socket.hpp"
#include "benchmarks/peers/peer.hpp"

namespace armature::benchmarks::peers {
namespace {

constexpr std::size_t kHeader = 16;
constexpr std::size_t kRequest = kHeader + 16;
constexpr std::size_t kLargeRequest = kHeader + 12 + 8 * 128;
constexpr std::size_t kReply = kHeader + 4;
constexpr std::int64_t kCommand = kHeader + 12;

/// A connection for each kind of message: none has to tell of which kind it is.
class RawServer final : public Server {
 public:
  RawServer() {
    thread_ = std::jthread([this] {
      const auto small = listener_.accept();
      const auto large = listener_.accept();
      const auto stream = listener_.accept();
      const std::jthread answers_small([&] { bare_answer(*small, kRequest, kReply); });
      const std::jthread answers_large([&] { bare_answer(*large, kLargeRequest, kReply); });
      bare_swallow(*stream);
    });
  }
  std::string address() const override { return std::to_string(listener_.port()); }

 private:
  BareListener listener_;
  std::jthread thread_;
};

class RawClient final : public Client {
 public:
  explicit RawClient(const std::string& address)
      : port_(static_cast<std::uint16_t>(std::stoi(address))),
        small_(bare_connection(port_)),
        large_(bare_connection(port_)),
        stream_(bare_connection(port_)) {}

  std::int32_t set_velocity(float left, float right) override {
    bare_ask(*small_, 1, kRequest, kReply);
    return peers::set_velocity(left, right);
  }
  std::int32_t set_all(const std::vector<double>& all) override {
    bare_ask(*large_, 1, kLargeRequest, kReply);
    return peers::set_all(all.size());
  }
  void drive(std::int64_t count) override { bare_pour(*stream_, count * kCommand); }

 private:
  std::uint16_t port_;
  std::unique_ptr<BareSocket> small_;
  std::unique_ptr<BareSocket> large_;
  std::unique_ptr<BareSocket> stream_;
};

}  // namespace

Peer raw() {
  return {"raw", [] { return std::make_unique<RawServer>(); },
          [](const std::string& address) { return std::make_unique<RawClient>(address); }};
}

}  // namespace armature::benchmarks::peers
