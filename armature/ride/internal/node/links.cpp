// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/node/links.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "armature/ride/internal/peer_state.hpp"

namespace armature::ride::internal {
namespace {

/// Without descriptors or memory a connection would be refused again and again.
constexpr base::Duration kNoDescriptors = std::chrono::milliseconds(100);

}  // namespace

Links::Links(NodeCore& core, LinkHost& host, const HostedServices& services, Reception& reception)
    : core_(core),
      host_(host),
      services_(services),
      reception_(reception),
      entrance_(*core.poller, core.options.limits.connections_per_second),
      handshakes_(
          core.options.name,
          [this](Link& link, Progress progress) {
            link.shakes_hands = false;
            if (link.come_back(progress)) is_up(link);
          },
          [&core] { core.poller->wake(); }) {}

// ---- Their coming

const Address& Links::listen(std::unique_ptr<Listener> listener) {
  return entrance_.add(std::move(listener));
}

void Links::accept(Listener& listener) {
  const base::Time now = core_.clock.look();
  auto connection = listener.accept();
  if (connection) {
    entrance_.count(now);
  } else {
    entrance_.pause(now + kNoDescriptors);
  }
  core_.clock.wake_at(entrance_.look_at_time(now));
  if (!connection) return;
  if (links_.size() >= core_.options.limits.connections && !make_room()) {
    return send_away(*connection,
                     "{} was sent away: {} connections are the most that this node accepts");
  }
  adopt(std::move(connection), listener.address().scheme);
}

/// Who has proven nothing yet makes room for others, the oldest first: connections that are only
/// begun keep nobody out.
bool Links::make_room() {
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

void Links::send_away(const Connection& connection, const char* why) {
  Counters::increase(core_.counters.connections_refused);
  core_.journal.tell(rt::LogLevel::kWarning, why, connection.other_end(), links_.size());
}

std::shared_ptr<Link> Links::adopt(std::unique_ptr<Connection> connection,
                                   const std::string& scheme) {
  const auto link =
      std::make_shared<Link>(host_, *core_.poller, core_.options.limits, core_.memory);
  if (!link->memory->open(false)) {
    send_away(*connection, "{} was sent away: {} connections use all the memory of this node");
    return nullptr;
  }
  links_.push_back(link);
  link->scheme = scheme;
  link->incomplete_since = core_.clock.now();
  link->begin(std::move(connection));
  core_.counters.connections.store(links_.size(), std::memory_order_relaxed);
  bring_up(*link);
  if (!link->established) {
    core_.clock.wake_at(base::later(core_.clock.now(), core_.options.limits.time_to_complete));
  }
  return link;
}

void Links::bring_up(Link& link) {
  if (link.shakes_hands) return;
  link.shakes_hands = link.hold();
  if (link.shakes_hands) return handshakes_.add(link.shared_from_this());
  if (link.establish()) is_up(link);
}

/// Data can flow.
void Links::is_up(Link& link) {
  link.established = true;
  link.incomplete_since = base::Time::max();
  if (link.peer != nullptr) link.peer->established();
}

// ---- Their life

/// Listeners are known by their place, links by where they are.
void Links::take_ready(const platform::Ready& ready) {
  const auto key = static_cast<std::uintptr_t>(ready.key);
  if (Listener* const listener = entrance_.find(key)) return accept(*listener);
  serve(*reinterpret_cast<Link*>(key), ready);
}

void Links::serve(Link& link, const platform::Ready& ready) {
  if (!link.established) return bring_up(link);
  if (ready.ended && link.is_leaving()) return link.break_off("the other side has ended it");
  const bool can_go_on_reading = ready.write && link.write();
  if (link.is_leaving()) return link.let_go_if_leaving();
  if (!ready.read && !can_go_on_reading) return;
  if (!link.waiting.empty()) return link.look_again();  // its turn comes when those are done
  const bool at_once = !link.sends_much;
  reception_.read(link);
  if (at_once && ready.ended) link.look_again();  // after what came last the end is to be seen
}

/// One that ends is taken from the list.
void Links::look_at_timers() {
  core_.clock.wake_at(entrance_.look_at_time(core_.clock.now()));
  const auto links = links_;
  for (const auto& link : links) reception_.look_at_timers(*link);
  if (core_.memory->is_in_use()) free_memory();
}

/// What all share is not for those who do not take what they are sent.
void Links::free_memory() {
  const base::Time now = core_.clock.now();
  const base::Duration limit = core_.options.limits.time_to_complete;
  for (const auto& link : links_) link->end_if_stuck(now, limit);
  core_.clock.wake_at(base::later(now, limit / 4));
}

void Links::end_events_of(std::uint32_t component) {
  for (const auto& link : links_) {
    const std::lock_guard lock(link->mutex());
    std::erase_if(link->event_queues,
                  [&](const auto& queue) { return queue->component == component; });
  }
}

// ---- Their end

/// Who waited to be looked after when there was no memory. One that ends is taken from the list.
void Links::look_after_all() {
  const auto links = links_;
  for (const auto& link : links) look_after(*link);
}

void Links::look_after(Link& link) {
  link.let_go_if_leaving();
  if (!link.ended() || link.shakes_hands) return;  // Then it is attended to when it comes back.
  const std::string why = link.problem();
  const std::string who = link.other_end();
  const bool was_established = link.established;
  services_.unsubscribe(link);
  if (!link.close()) return;  // The thread that still has it comes back with it.
  reception_.forget(link);
  if (link.peer != nullptr) return link.peer->lost(why);
  tell_end(who, was_established, why);
  end(link);
}

void Links::tell_end(const std::string& who, bool was_established, std::string_view why) {
  if (was_established) return core_.journal.tell(rt::LogLevel::kInfo, "{} is gone: {}", who, why);
  Counters::increase(core_.counters.connections_refused);
  core_.journal.tell(rt::LogLevel::kWarning, "{} was refused: {}", who, why);
}

void Links::end(Link& link) {
  const auto at = std::ranges::find(links_, &link, &std::shared_ptr<Link>::get);
  if (at == links_.end()) return;
  link.memory->end();
  departed_.push_back(std::move(*at));
  links_.erase(at);
  core_.counters.connections.store(links_.size(), std::memory_order_relaxed);
}

void Links::forget_departed() {
  std::erase_if(departed_, [](const auto& link) { return link->waiting.empty(); });
}

void Links::leave_all(const char* why) {
  for (const auto& link : links_) leave(*link, why);
}

void Links::close_all() {
  for (const auto& link : links_) link->close();
}

void Links::forget_all() {
  links_.clear();
  departed_.clear();
  entrance_.close();
}

void leave(Link& link, const char* why) {
  link.send_control(0, {Code::kShuttingDown, 0, 0, 0, why});
  link.break_off(why);
}

}  // namespace armature::ride::internal
