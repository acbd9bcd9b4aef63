// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/node/transports.hpp"

#include <algorithm>
#include <utility>

#include "armature/platform/sockets/stream_socket.hpp"

namespace armature::ride::internal {
namespace {

bool is_of_this_machine(const Address& address) {
  return address.scheme == "unix" || platform::is_loopback(address.host);
}

}  // namespace

Transports::Transports(const NodeOptions& options) : options_(options), all_(options.transports) {
  all_.push_back(make_tcp_transport());
  all_.push_back(make_unix_transport(options.socket_mode));
}

Transport* Transports::find(const std::string& scheme) const {
  const auto found = std::ranges::find_if(
      all_, [&](const auto& transport) { return transport->scheme() == scheme; });
  return found == all_.end() ? nullptr : found->get();
}

base::Result<Transports::Place> Transports::place_of(const std::string& text) const {
  auto address = Address::parse(text);
  if (!address) return base::Error{address.error()};
  Transport* const transport = find(address.value().scheme);
  if (transport == nullptr) {
    return base::Error{"'" + text + "': node '" + options_.name + "' has no transport '" +
                       address.value().scheme + "'"};
  }
  return Place{transport, std::move(address).value()};
}

base::Result<Transports::Place> Transports::place_to_listen(const std::string& text) const {
  const auto place = place_of(text);
  if (!place) return place;
  Transport* const transport = place.value().transport;
  const auto numeric = transport->look_up(place.value().address);
  if (!numeric) return base::Error{"'" + text + "': " + numeric.error()};
  if (!transport->safe(numeric.value())) {
    return base::Error{"'" + text +
                       "': other machines would reach this address without proving who they are; "
                       "listen at 127.0.0.1, ::1 or a unix: socket, or use tls"};
  }
  if (!options_.allows && !is_of_this_machine(numeric.value())) {
    return base::Error{"'" + text +
                       "': other machines would reach this address, and no policy says what they "
                       "may do; give node '" +
                       options_.name + "' a policy, or listen at 127.0.0.1, ::1 or a unix: socket"};
  }
  return Place{transport, numeric.value()};
}

}  // namespace armature::ride::internal
