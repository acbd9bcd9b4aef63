// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/internal/can_state.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>

#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <sys/socket.h>

#include "armature/platform/internal/descriptor.hpp"

namespace armature::platform::internal {
namespace {

using Bytes = std::span<const std::byte>;

struct LinkMessage {
  nlmsghdr header;
  ifinfomsg link;
};

/// The content of an attribute; empty if there is none of that type.
Bytes attribute(Bytes all, unsigned type) {
  rtattr head{};
  while (all.size() >= sizeof head) {
    std::memcpy(&head, all.data(), sizeof head);
    if (head.rta_len < sizeof head || head.rta_len > all.size()) break;
    if ((head.rta_type & NLA_TYPE_MASK) == type) {
      return all.subspan(sizeof head, head.rta_len - sizeof head);
    }
    all = all.subspan(std::min<std::size_t>(RTA_ALIGN(head.rta_len), all.size()));
  }
  return {};
}

/// What the kernel tells of an interface: attributes.
Bytes ask(unsigned interface, std::span<std::byte> room) {
  const Descriptor socket(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE));
  LinkMessage message{};
  message.header.nlmsg_len = sizeof message;
  message.header.nlmsg_type = RTM_GETLINK;
  message.header.nlmsg_flags = NLM_F_REQUEST;
  message.link.ifi_index = static_cast<int>(interface);
  if (::send(socket.get(), &message, sizeof message, 0) != sizeof message) return {};
  const ssize_t size = ::recv(socket.get(), room.data(), room.size(), MSG_DONTWAIT);
  if (size < static_cast<ssize_t>(sizeof message)) return {};
  std::memcpy(&message, room.data(), sizeof message);
  if (message.header.nlmsg_type != RTM_NEWLINK) return {};
  return room.first(static_cast<std::size_t>(size)).subspan(sizeof message);
}

bool is_can(Bytes kind) {
  constexpr std::string_view kCan("can\0", 4);
  return std::ranges::equal(kind, std::as_bytes(std::span(kCan)));
}

}  // namespace

std::optional<std::uint32_t> can_state(unsigned interface) {
  std::array<std::byte, 32 * 1024> room;
  const Bytes info = attribute(ask(interface, room), IFLA_LINKINFO);
  if (!is_can(attribute(info, IFLA_INFO_KIND))) return {};
  const Bytes content = attribute(attribute(info, IFLA_INFO_DATA), IFLA_CAN_STATE);
  std::uint32_t state = 0;
  if (content.size() != sizeof state) return {};
  std::memcpy(&state, content.data(), sizeof state);
  return state;
}

}  // namespace armature::platform::internal
