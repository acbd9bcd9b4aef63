// SPDX-License-Identifier: Apache-2.0
#include "armature/can/make_bus.hpp"

#include "armature/can/shared_bus.hpp"
#include "armature/can/socket_can.hpp"

namespace armature::can {
namespace {

constexpr std::string_view kVirtual = "virtual:";

}  // namespace

bool is_virtual(std::string_view name) { return name.starts_with(kVirtual); }

std::unique_ptr<Bus> make_bus(const std::string& name, std::uint32_t bit_rate) {
  if (!name.starts_with(kVirtual)) return std::make_unique<SocketCan>(name);
  return std::make_unique<SharedBus>(name.substr(kVirtual.size()), bit_rate);
}

}  // namespace armature::can
