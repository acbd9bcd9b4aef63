// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/messages.hpp"

#include <utility>

namespace armature::websocket {

std::vector<Incoming> Messages::take(base::Duration limit) {
  std::unique_lock lock(mutex_);
  came_.wait_for(lock, limit, [this] { return woken_ || !incoming_.empty(); });
  woken_ = false;
  for (auto& [number, client] : clients_) {
    const bool held_up = client.asked >= options_.asked;
    client.asked = 0;
    if (held_up) client.ring();
  }
  return std::exchange(incoming_, {});
}

void Messages::wake() {
  const std::scoped_lock lock(mutex_);
  woken_ = true;
  came_.notify_all();
}

bool Messages::offer(std::uint32_t client, std::string binary) {
  const std::scoped_lock lock(mutex_);
  const auto found = clients_.find(client);
  if (found == clients_.end()) return false;
  if (found->second.queued_bytes + binary.size() > options_.queue_bytes) return false;
  put(found->second, {false, std::move(binary)});
  return true;
}

void Messages::send(std::uint32_t client, Outgoing message) {
  const std::scoped_lock lock(mutex_);
  const auto found = clients_.find(client);
  if (found == clients_.end() || found->second.given_up) return;
  if (found->second.queued_bytes + message.content.size() > options_.most_bytes) {
    found->second.given_up = true;
    return found->second.ring();
  }
  put(found->second, std::move(message));
}

void Messages::put(Client& client, Outgoing message) {
  client.queued_bytes += message.content.size();
  client.queue.push_back(std::move(message));
  if (client.queue.size() == 1) client.ring();
}

std::vector<std::string> Messages::addresses() const {
  const std::scoped_lock lock(mutex_);
  return addresses_;
}

std::optional<std::uint32_t> Messages::enter(std::function<void()> ring,
                                             std::unique_ptr<ride::Connection> inside) {
  const std::scoped_lock lock(mutex_);
  if (clients_.size() >= options_.clients) return std::nullopt;
  clients_[++last_].ring = std::move(ring);
  incoming_.push_back({last_, Incoming::Kind::kCame, {}, std::move(inside)});
  came_.notify_all();
  return last_;
}

void Messages::leave(std::uint32_t client) {
  const std::scoped_lock lock(mutex_);
  if (clients_.erase(client) == 0) return;
  incoming_.push_back({client, Incoming::Kind::kGone, {}, nullptr});
  came_.notify_all();
}

void Messages::receive(std::uint32_t client, bool text, std::string content) {
  const std::scoped_lock lock(mutex_);
  const auto found = clients_.find(client);
  if (found == clients_.end()) return;
  ++found->second.asked;
  incoming_.push_back({client, text ? Incoming::Kind::kText : Incoming::Kind::kBinary,
                       std::move(content), nullptr});
  came_.notify_all();
}

bool Messages::reads(std::uint32_t client) const {
  const std::scoped_lock lock(mutex_);
  const auto found = clients_.find(client);
  return found != clients_.end() && found->second.asked < options_.asked;
}

bool Messages::gives_up(std::uint32_t client) const {
  const std::scoped_lock lock(mutex_);
  const auto found = clients_.find(client);
  return found == clients_.end() || found->second.given_up;
}

std::optional<Outgoing> Messages::next(std::uint32_t client) {
  const std::scoped_lock lock(mutex_);
  const auto found = clients_.find(client);
  if (found == clients_.end() || found->second.queue.empty()) return std::nullopt;
  Outgoing message = std::move(found->second.queue.front());
  found->second.queue.pop_front();
  found->second.queued_bytes -= message.content.size();
  return message;
}

bool Messages::has_next(std::uint32_t client) const {
  const std::scoped_lock lock(mutex_);
  const auto found = clients_.find(client);
  return found != clients_.end() && !found->second.queue.empty();
}

void Messages::add_address(std::string address) {
  const std::scoped_lock lock(mutex_);
  addresses_.push_back(std::move(address));
}

}  // namespace armature::websocket
