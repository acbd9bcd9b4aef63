// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/address.hpp"

#include <charconv>

namespace armature::ride {
namespace {

base::Error wrong(std::string_view text, const std::string& what) {
  return base::Error{"'" + std::string(text) + "': " + what +
                     "; expected an address such as tcp://127.0.0.1:4242, tcp://[::1]:4242 or "
                     "unix:/run/robot.sock"};
}

}  // namespace

std::string Address::text() const {
  if (scheme == "unix") return "unix:" + host;
  const bool version_6 = host.find(':') != std::string::npos;
  return scheme + "://" + (version_6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

base::Result<Address> Address::parse(std::string_view text) {
  Address address;
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos || colon == 0) return wrong(text, "has no transport");
  address.scheme = text.substr(0, colon);
  std::string_view rest = text.substr(colon + 1);
  if (address.scheme == "unix") {
    if (rest.empty()) return wrong(text, "has no path");
    address.host = rest;
    return address;
  }
  if (!rest.starts_with("//")) return wrong(text, "has no // behind the transport");
  rest.remove_prefix(2);
  const std::size_t port = rest.rfind(':');
  if (port == std::string_view::npos) return wrong(text, "has no port");
  const std::string_view digits = rest.substr(port + 1);
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), address.port);
  if (error != std::errc() || end != digits.data() + digits.size() || digits.empty()) {
    return wrong(text, "its port is not a number from 0 to 65535");
  }
  std::string_view host = rest.substr(0, port);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  if (host.empty()) return wrong(text, "has no host");
  address.host = host;
  return address;
}

}  // namespace armature::ride
