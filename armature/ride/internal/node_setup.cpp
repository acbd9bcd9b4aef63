// SPDX-License-Identifier: Apache-2.0
// Of NodeState: what it listens at, hosts and connects to.
#include <algorithm>
#include <utility>

#include "armature/platform/stream_socket.hpp"
#include "armature/ride/internal/node_state.hpp"
#include "armature/ride/internal/peer_state.hpp"
#include "armature/ride/internal/publisher.hpp"

namespace armature::ride::internal {
namespace {

bool is_of_this_machine(const Address& address) {
  return address.scheme == "unix" || platform::is_loopback(address.host);
}

}  // namespace

base::Result<Address> NodeState::listen(const std::string& text) {
  auto address = Address::parse(text);
  if (!address) return address;
  Transport* const transport = find_transport(address.value().scheme);
  if (transport == nullptr) {
    return base::Error{"'" + text + "': node '" + options_.name + "' has no transport '" +
                       address.value().scheme + "'"};
  }
  const auto numeric = transport->look_up(address.value());
  if (!numeric) return base::Error{"'" + text + "': " + numeric.error()};
  if (!transport->safe(numeric.value())) {
    return base::Error{"'" + text +
                       "': other machines would reach this address and nobody would have to prove "
                       "who they are; listen at 127.0.0.1, ::1 or a unix: socket, or use tls"};
  }
  if (!options_.allows && !is_of_this_machine(numeric.value())) {
    return base::Error{"'" + text +
                       "': other machines would reach this address, and nothing says what they may "
                       "do; give node '" +
                       options_.name + "' a policy, or listen at 127.0.0.1, ::1 or a unix: socket"};
  }
  base::Result<Address> got = base::Error{};
  run([&] { got = listen_at(numeric.value()); });
  return got;
}

base::Result<Address> NodeState::listen_at(const Address& address) {
  auto listener = find_transport(address.scheme)->listen(address);
  if (!listener) return base::Error{listener.error()};
  listeners_.push_back(std::move(listener).value());
  const Listener& added = *listeners_.back();
  poller_->add(added.handle(), listeners_.size() - 1, {.read = true});
  return added.address();
}

/// Who has proven nothing yet makes room for others, the oldest first: connections that are only
/// begun keep nobody out.
bool NodeState::make_room() {
  const auto half_open = std::ranges::find_if(
      links_, [](const auto& link) { return !link->established && link->problem().empty(); });
  if (half_open == links_.end()) return false;
  (*half_open)->break_off("others came before its handshake was done");
  return true;
}

void NodeState::tell_end(const std::string& who, bool was_established, std::string_view why) {
  if (was_established) return journal_.tell(rt::LogLevel::kInfo, "{} is gone: {}", who, why);
  counters_.connections_refused.fetch_add(1, std::memory_order_relaxed);
  journal_.tell(rt::LogLevel::kWarning, "{} was refused: {}", who, why);
}

base::Result<std::uint32_t> NodeState::add(std::string name, Service& service) {
  base::Result<std::uint32_t> identifier = base::Error{};
  run([&] {
    const auto found = std::ranges::find_if(hosted_, [&](const Hosted& hosted) {
      return hosted.service == &service || (hosted.service != nullptr && hosted.name == name);
    });
    if (found != hosted_.end()) {
      identifier = base::Error{"node '" + options_.name + "' already hosts '" + found->name +
                               "': give '" + name + "' another name, or remove the first"};
      return;
    }
    const auto next = static_cast<std::uint32_t>(hosted_.size() + 1);
    hosted_.push_back({next, std::move(name), digest(service.interface()), &service});
    identifier = next;
  });
  return identifier;
}

void NodeState::remove(Service& service) {
  run([&] {
    for (Hosted& hosted : hosted_) {
      if (hosted.service != &service) continue;
      hosted.service = nullptr;
      ServiceAccess::publisher(service).remove_all();
      for (const auto& link : links_) {
        const std::lock_guard lock(link->mutex());
        std::erase_if(link->event_queues,
                      [&](const auto& queue) { return queue->component == hosted.identifier; });
      }
    }
  });
}

Peer& NodeState::connect(const std::string& text) {
  auto address = Address::parse(text);
  Transport* const transport = address ? find_transport(address.value().scheme) : nullptr;
  if (address && transport == nullptr) {
    address = base::Error{"'" + text + "': node '" + options_.name + "' has no transport '" +
                          address.value().scheme + "'"};
  }
  if (address) address = transport->look_up(address.value());
  Peer* peer = nullptr;
  run([&] {
    const auto known =
        std::ranges::find_if(peers_, [&](const auto& other) { return other->address() == text; });
    if (known != peers_.end()) {
      peer = known->get();
      return;
    }
    peers_.push_back(std::make_unique<Peer>(std::make_shared<PeerState>(*this, text)));
    peer = peers_.back().get();
    peer->state()->start(transport, std::move(address));
  });
  return *peer;
}

NodeStatistics NodeState::statistics() const {
  const auto get = [](const auto& counter) { return counter.load(std::memory_order_relaxed); };
  return {get(counters_.connections),     get(counters_.connections_refused),
          get(counters_.messages),        get(counters_.refusals),
          get(counters_.commands_failed), get(counters_.events_dropped),
          get(counters_.throttled)};
}

}  // namespace armature::ride::internal
