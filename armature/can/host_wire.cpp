// SPDX-License-Identifier: Apache-2.0
#include "armature/can/host_wire.hpp"

#include <utility>

#include "armature/can/bus_server.hpp"
#include "armature/can/socket_can.hpp"
#include "armature/rt/wakeup.hpp"

namespace armature::can {
namespace {

class SharedWire final : public HostWire {
 public:
  explicit SharedWire(std::unique_ptr<BusServer> server) : server_(std::move(server)) {}
  void take() override { server_->take(); }
  void give() override { server_->give(); }
  void wait_until(base::Time deadline) override { server_->wait_until(deadline); }

 private:
  std::unique_ptr<BusServer> server_;
};

/// Carries frames between the interface and a station of the virtual bus. What either does not take
/// is lost, as on a wire that nobody hears; both count it. Frames of the virtual bus are always
/// acknowledged, since the interface is there: who is not would try again without end, and on a bus
/// without a time of its own that is faster than it can be simulated.
class InterfaceWire final : public HostWire {
 public:
  InterfaceWire(VirtualBus& bus, const std::string& interface)
      : inside_(bus.add_station("interface")),
        acknowledging_(bus.add_station("acknowledging")),
        outside_(interface) {}

  bool open(base::Diagnostics& diagnostics) {
    BusOptions options;
    options.on_news = [this] { news_.notify(); };
    const BusOptions deaf{.filters = {{Frame::kMostExtended, Frame::kMostExtended}}};
    return inside_.open({}, diagnostics) && acknowledging_.open(deaf, diagnostics) &&
           outside_.open(options, diagnostics);
  }
  void take() override { carry(outside_, inside_); }
  void give() override { carry(inside_, outside_); }
  void wait_until(base::Time deadline) override { news_.wait_until(deadline); }

 private:
  static void carry(Bus& from, Bus& to) {
    Arrival arrival;
    while (from.receive(arrival) == ReceiveStatus::kReceived) {
      static_cast<void>(to.send(arrival.frame));
    }
  }

  rt::Wakeup news_;
  VirtualStation& inside_;
  VirtualStation& acknowledging_;
  SocketCan outside_;
};

}  // namespace

std::unique_ptr<HostWire> make_shared_wire(VirtualBus& bus, const std::string& path,
                                           base::Diagnostics& diagnostics) {
  auto server = BusServer::open(bus, path, diagnostics);
  if (server == nullptr) return nullptr;
  return std::make_unique<SharedWire>(std::move(server));
}

std::unique_ptr<HostWire> make_interface_wire(VirtualBus& bus, const std::string& interface,
                                              base::Diagnostics& diagnostics) {
  auto wire = std::make_unique<InterfaceWire>(bus, interface);
  if (!wire->open(diagnostics)) return nullptr;
  return wire;
}

}  // namespace armature::can
