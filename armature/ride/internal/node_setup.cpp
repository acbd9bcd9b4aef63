// SPDX-License-Identifier: Apache-2.0
// Of NodeState: what it listens at, hosts and connects to.
#include <algorithm>
#include <cstdio>
#include <utility>

#include "armature/platform/sockets/stream_socket.hpp"
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
  if (got && !options_.allows) warn_of_everyone(got.value());
  return got;
}

/// What a newcomer does not expect.
void NodeState::warn_of_everyone(const Address& address) {
  constexpr unsigned kOthers = 0022;
  if (address.scheme == "unix" && (options_.socket_mode & kOthers) == 0) return;
  constexpr const char* kWarning =
      "everyone on this machine may do everything at {}: there is no policy (NodeOptions::allows)";
  journal_.tell(rt::LogLevel::kWarning, kWarning, address.text());
  if (options_.log) return;
  std::fprintf(stderr,
               "ride: everyone on this machine may do everything at %s: there is no policy "
               "(NodeOptions::allows)\n",
               address.text().c_str());
}

base::Result<Address> NodeState::listen_at(const Address& address) {
  auto listener = find_transport(address.scheme)->listen(address);
  if (!listener) return base::Error{listener.error()};
  return entrance_.add(std::move(listener).value());
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
    const std::lock_guard lock(hosted_mutex_);
    hosted_.push_back({next, std::move(name), digest(service.interface()), &service});
    identifier = next;
  });
  return identifier;
}

void NodeState::remove(Service& service) {
  run([&] {
    for (Hosted& hosted : hosted_) {
      if (hosted.service != &service) continue;
      {
        const std::lock_guard lock(hosted_mutex_);
        hosted.service = nullptr;
      }
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
          get(counters_.throttled),       memory_->used()};
}

}  // namespace armature::ride::internal
