// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/server.hpp"

#include <atomic>
#include <chrono>
#include <map>
#include <utility>

#include "armature/foxglove/internal/protocol.hpp"
#include "armature/foxglove/internal/session.hpp"
#include "armature/platform/clock.hpp"
#include "armature/platform/thread.hpp"

namespace armature::foxglove {

using namespace std::chrono_literals;
using websocket::Incoming;

std::shared_ptr<websocket::Messages> make_messages() {
  return std::make_shared<websocket::Messages>(websocket::Messages::Options{
      .subprotocol = internal::kSubprotocol, .path = "/foxglove/", .identity = kIdentity});
}

/// The thread, and the sessions in it.
class Server::Work {
 public:
  Work(std::shared_ptr<websocket::Messages> messages, ServerOptions options)
      : messages_(std::move(messages)), options_(std::move(options)) {
    platform::ThreadRequest request;
    request.name = "foxglove";
    thread_ = std::make_unique<platform::Thread>(request, [this] { run(); });
  }
  ~Work() {
    ends_ = true;
    messages_->wake();
    thread_.reset();
  }

 private:
  static constexpr base::Duration kPeriod = 10ms;
  static constexpr base::Duration kPeriodAlone = 500ms;

  void run() {
    while (!ends_) {
      for (Incoming& one : messages_->take(sessions_.empty() ? kPeriodAlone : kPeriod)) {
        take(std::move(one));
      }
      for (auto& [client, session] : sessions_) session->look(platform::monotonic_now());
    }
    sessions_.clear();
  }

  void take(Incoming one) {
    if (one.kind == Incoming::Kind::kCame) {
      sessions_[one.client] = std::make_unique<internal::Session>(*messages_, one.client,
                                                                  std::move(one.inside), options_);
    } else if (one.kind == Incoming::Kind::kGone) {
      sessions_.erase(one.client);
    } else if (const auto found = sessions_.find(one.client); found != sessions_.end()) {
      found->second->take(one.kind == Incoming::Kind::kText, one.content);
    }
  }

  const std::shared_ptr<websocket::Messages> messages_;
  const ServerOptions options_;
  std::map<std::uint32_t, std::unique_ptr<internal::Session>> sessions_;
  std::atomic<bool> ends_{false};
  std::unique_ptr<platform::Thread> thread_;
};

Server::Server(std::shared_ptr<websocket::Messages> messages, ServerOptions options)
    : work_(std::make_unique<Work>(std::move(messages), std::move(options))) {}

Server::~Server() = default;

}  // namespace armature::foxglove
