// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/socket_connection.hpp"

#include <utility>

namespace armature::ride {
namespace {

using platform::StreamSocket;
using platform::StreamStatus;

Progress progress_of(StreamStatus status, Progress later) {
  if (status == StreamStatus::kDone) return Progress::kDone;
  return status == StreamStatus::kLater ? later : Progress::kGone;
}

class SocketConnection final : public Connection {
 public:
  explicit SocketConnection(std::unique_ptr<StreamSocket> socket, std::string identity = {})
      : socket_(std::move(socket)), identity_(std::move(identity)) {}

  int handle() const override { return socket_->handle(); }
  Progress establish() override {
    return progress_of(socket_->finish_connect(), Progress::kWantWrite);
  }
  Progress send(std::span<const std::byte> bytes, std::size_t& sent) override {
    return progress_of(socket_->send(bytes, sent), Progress::kWantWrite);
  }
  Progress receive(std::span<std::byte> room, std::size_t& size) override {
    return progress_of(socket_->receive(room, size), Progress::kWantRead);
  }
  bool takes_all() const override { return true; }
  Progress wait_and_receive(std::span<std::byte> room, std::size_t& size,
                            base::Duration limit) override {
    return progress_of(socket_->wait_and_receive(room, size, limit), Progress::kWantRead);
  }
  void set_level(int level) override { static_cast<void>(socket_->set_priority(level)); }
  void shut_down() override { socket_->shut_down(); }
  std::string other_end() const override { return socket_->other_end(); }
  std::string identity() const override { return identity_; }
  std::string problem() const override { return socket_->problem(); }
  bool may_still_receive() const override { return socket_->ended_in_order(); }

 private:
  std::unique_ptr<StreamSocket> socket_;
  const std::string identity_;
};

}  // namespace

std::unique_ptr<Connection> make_connection(std::unique_ptr<StreamSocket> socket,
                                            std::string identity) {
  return std::make_unique<SocketConnection>(std::move(socket), std::move(identity));
}

}  // namespace armature::ride
