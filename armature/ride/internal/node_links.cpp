// SPDX-License-Identifier: Apache-2.0
// Of NodeState: its connections, from their coming to their end.
#include <algorithm>
#include <chrono>
#include <utility>

#include "armature/platform/clock.hpp"
#include "armature/ride/internal/node_state.hpp"
#include "armature/ride/internal/peer_state.hpp"
#include "armature/ride/internal/publisher.hpp"

namespace armature::ride::internal {
namespace {

/// Without descriptors or memory a connection would be refused again and again.
constexpr base::Duration kNoDescriptors = std::chrono::milliseconds(100);

}  // namespace

void NodeState::accept(Listener& listener) {
  now_ = platform::monotonic_now();
  auto connection = listener.accept();
  if (connection) {
    entrance_.count(now_);
  } else {
    entrance_.pause(now_ + kNoDescriptors);
  }
  wake_at(entrance_.look_at_time(now_));
  if (!connection) return;
  if (links_.size() >= options_.limits.connections && !make_room()) {
    return send_away(*connection,
                     "{} was sent away: {} connections are the most that this node accepts");
  }
  adopt(std::move(connection), listener.address().scheme);
}

/// Who has proven nothing yet makes room for others, the oldest first: connections that are only
/// begun keep nobody out.
bool NodeState::make_room() {
  const auto half_open = std::ranges::find_if(links_, [](const auto& link) {
    return (!link->established || link->is_leaving()) && link->problem().empty();
  });
  if (half_open == links_.end()) return false;
  (*half_open)->memory->end();  // for whom it makes room
  (*half_open)
      ->break_off((*half_open)->is_leaving()
                      ? "it has stopped sending, and newer connections came"
                      : "newer connections came before its handshake was done");
  return true;
}

void NodeState::send_away(const Connection& connection, const char* why) {
  counters_.connections_refused.fetch_add(1, std::memory_order_relaxed);
  journal_.tell(rt::LogLevel::kWarning, why, connection.other_end(), links_.size());
}

std::shared_ptr<Link> NodeState::adopt(std::unique_ptr<Connection> connection,
                                       const std::string& scheme) {
  const auto link = std::make_shared<Link>(*this, *poller_, options_.limits, memory_);
  if (!link->memory->open(false)) {
    send_away(*connection, "{} was sent away: {} connections use all the memory of this node");
    return nullptr;
  }
  links_.push_back(link);
  link->scheme = scheme;
  link->incomplete_since = now_;
  link->begin(std::move(connection));
  counters_.connections.store(links_.size(), std::memory_order_relaxed);
  service_link(*link, {});
  if (!link->established) wake_at(base::later(now_, options_.limits.time_to_complete));
  return link;
}

void NodeState::bring_up(Link& link) {
  if (link.shakes_hands) return;
  link.shakes_hands = link.hold();
  if (link.shakes_hands) return handshakes_.add(link.shared_from_this());
  if (link.establish()) is_up(link);
}

/// Data can flow.
void NodeState::is_up(Link& link) {
  link.established = true;
  link.incomplete_since = base::Time::max();
  if (link.peer != nullptr) link.peer->established();
}

/// Who waited to be looked after when there was no memory.
void NodeState::look_after_all() {
  const auto links = links_;  // One that ends is taken from the list.
  for (const auto& link : links) look_after(*link);
  for (const auto& peer : peers_) look_after(peer->state()->link());
}

/// Who sends no more gets the answers that it is owed.
void NodeState::let_go(Link& link) {
  if (link.is_leaving() && link.waiting.empty()) link.end_if_all_is_sent();
}

/// A connection has ended.
void NodeState::look_after(Link& link) {
  let_go(link);
  if (!link.ended() || link.shakes_hands) return;  // Then it is attended to when it comes back.
  const std::string why = link.problem();
  const std::string who = link.other_end();
  const bool was_established = link.established;
  for (Hosted& hosted : hosted_) {
    if (hosted.service != nullptr) ServiceAccess::publisher(*hosted.service).remove(link);
  }
  if (!link.close()) return;  // The thread that still has it comes back with it.
  if (std::exchange(link.waits_for_turn, false)) std::erase(greedy_, &link);
  if (link.peer != nullptr) return link.peer->lost(why);
  tell_end(who, was_established, why);
  end(link);
}

void NodeState::tell_end(const std::string& who, bool was_established, std::string_view why) {
  if (was_established) return journal_.tell(rt::LogLevel::kInfo, "{} is gone: {}", who, why);
  counters_.connections_refused.fetch_add(1, std::memory_order_relaxed);
  journal_.tell(rt::LogLevel::kWarning, "{} was refused: {}", who, why);
}

void NodeState::end(Link& link) {
  const auto at = std::ranges::find(links_, &link, &std::shared_ptr<Link>::get);
  if (at == links_.end()) return;
  link.memory->end();
  departed_.push_back(std::move(*at));
  links_.erase(at);
  counters_.connections.store(links_.size(), std::memory_order_relaxed);
}

void NodeState::forget_departed() {
  std::erase_if(departed_, [](const auto& link) { return link->waiting.empty(); });
}

}  // namespace armature::ride::internal
