// SPDX-License-Identifier: Apache-2.0
#include "armature/can/bus_server.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <span>
#include <utility>

#include "armature/can/internal/shared_bus_messages.hpp"
#include "armature/platform/clock.hpp"

namespace armature::can {
namespace {

using internal::FromBus;
using internal::FromBusMessage;
using internal::Hello;
using internal::SharedFilter;
using internal::StationStatus;
using internal::ToBus;
using internal::ToBusMessage;
using platform::PacketReceived;
using platform::PacketSent;

/// Of one client, before the bus goes on.
constexpr int kMostPacketsAtOnce = 32;
constexpr int kMostAcceptedAtOnce = 8;
/// Who has not said by then what it wants, wants nothing.
constexpr base::Duration kLongestSilence = std::chrono::seconds(1);
/// What was sent longer ago is not for now any more: the bus was stopped meanwhile.
constexpr base::Duration kOldestFrame = std::chrono::milliseconds(100);

constexpr std::size_t kLargestPacket =
    sizeof(Hello) + internal::kMostSharedFilters * sizeof(SharedFilter);

}  // namespace

/// A place, and the station that whoever has it uses.
struct BusServer::Client {
  explicit Client(VirtualStation& its_station) : station(its_station) {}

  void begin(base::Time now) {
    came = now;
    welcomed = false;
    taken = stale = 0;
    told = {};
    held.reset();
  }
  StationStatus status() const {
    const BusCounters counters = station.counters();
    StationStatus now;
    now.finished = taken - station.waiting();
    now.discarded = counters.discarded - before.discarded + stale;
    now.lost = counters.lost - before.lost;
    now.error_frames = counters.error_frames - before.error_frames;
    now.bus_offs = counters.bus_offs - before.bus_offs;
    now.state = static_cast<std::uint32_t>(station.state());
    return now;
  }

  VirtualStation& station;
  base::Time came{};
  bool welcomed = false;
  BusCounters before;           ///< of the station, when the client came
  std::uint64_t taken = 0;      ///< frames of the client
  std::uint64_t stale = 0;      ///< of these, those that are not sent any more
  StationStatus told;           ///< to the client
  std::optional<Arrival> held;  ///< for which there was no room
};

std::unique_ptr<BusServer> BusServer::open(VirtualBus& bus, const std::string& path,
                                           base::Diagnostics& diagnostics) {
  auto socket = platform::PacketServer::listen(path, kMostClients);
  if (!socket) {
    diagnostics.error({}, "bus '" + bus.name() + "' cannot be shared: " + socket.error(),
                      "choose another path, or stop what has this one");
    return nullptr;
  }
  return std::unique_ptr<BusServer>(new BusServer(bus, std::move(socket).value()));
}

BusServer::BusServer(VirtualBus& bus, std::unique_ptr<platform::PacketServer> socket)
    : socket_(std::move(socket)), room_(kLargestPacket) {
  for (std::size_t place = 0; place < kMostClients; ++place) {
    clients_.push_back(
        std::make_unique<Client>(bus.add_station("client" + std::to_string(place + 1))));
  }
}

BusServer::~BusServer() {
  for (std::size_t place = 0; place < clients_.size(); ++place) drop(place);
}

std::size_t BusServer::clients() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(clients_, [](const auto& client) { return client->welcomed; }));
}

void BusServer::take() {
  accept_clients();
  for (std::size_t place = 0; place < clients_.size(); ++place) {
    if (socket_->taken(place)) take_from(place);
  }
}

void BusServer::accept_clients() {
  for (int i = 0; i < kMostAcceptedAtOnce; ++i) {
    const std::size_t place = socket_->accept();
    if (place == clients_.size()) return;
    clients_[place]->begin(platform::monotonic_now());
  }
}

void BusServer::take_from(std::size_t place) {
  for (int i = 0; i < kMostPacketsAtOnce; ++i) {
    std::size_t size = 0;
    const auto received = socket_->receive(place, room_, size);
    if (received == PacketReceived::kGone) return drop(place);
    if (received == PacketReceived::kNothing) break;
    if (!take_packet(place, size)) return send_away(place);
  }
  const Client& client = *clients_[place];
  const bool silent = platform::monotonic_now() - client.came > kLongestSilence;
  if (!client.welcomed && silent) send_away(place);
}

/// False if it is none that this client may send now.
bool BusServer::take_packet(std::size_t place, std::size_t size) {
  Client& client = *clients_[place];
  if (!client.welcomed) return welcome(place, size);
  if (size != sizeof(ToBusMessage)) return false;
  const auto message = internal::message_of<ToBusMessage>(room_);
  if (message.kind == ToBus::kRestart) {
    static_cast<void>(client.station.restart());
    return true;
  }
  const Frame frame = internal::from_shared(message.frame);
  if (message.kind != ToBus::kFrame || !can_be_sent(frame)) return false;
  ++client.taken;
  const base::Time sent = base::time_from_ns(message.time_ns);
  const bool fresh = sent >= platform::monotonic_now() - kOldestFrame;
  if (!fresh || client.station.send(frame) != SendStatus::kSent) ++client.stale;
  return true;
}

bool BusServer::welcome(std::size_t place, std::size_t size) {
  Client& client = *clients_[place];
  BusOptions options;
  std::uint32_t bit_rate = 0;
  base::Diagnostics diagnostics;
  if (size > room_.size() ||
      !internal::parse_hello(std::span(room_).first(size), options, bit_rate) ||
      !client.station.open(options, diagnostics)) {
    return false;
  }
  client.station.set_bit_rate(bit_rate);
  client.before = client.station.counters();
  client.welcomed = true;
  FromBusMessage message;
  message.kind = FromBus::kWelcome;
  message.status = client.told = client.status();
  return socket_->send(place, internal::bytes_of(message)) == PacketSent::kYes;
}

void BusServer::give() {
  for (std::size_t place = 0; place < clients_.size(); ++place) {
    if (clients_[place]->welcomed) give_to(place);
  }
}

/// In the order of the bus; what finds no room waits, and then in the station's own queue.
void BusServer::give_to(std::size_t place) {
  Client& client = *clients_[place];
  while (true) {
    Arrival arrival;
    if (!client.held) {
      if (client.station.receive(arrival) != ReceiveStatus::kReceived) break;
      client.held = arrival;
    }
    FromBusMessage message;
    message.kind = FromBus::kFrame;
    message.time_ns = base::to_ns(client.held->time);
    message.frame = internal::to_shared(client.held->frame, client.held->own);
    message.status = client.status();
    const auto sent = socket_->send(place, internal::bytes_of(message));
    socket_->set_wants_to_send(place, sent == PacketSent::kFull);
    if (sent == PacketSent::kGone) return drop(place);
    if (sent == PacketSent::kFull) return;
    client.told = message.status;
    client.held.reset();
  }
  if (client.status() != client.told && !send_status(place)) drop(place);
}

/// False if the client has gone.
bool BusServer::send_status(std::size_t place) {
  Client& client = *clients_[place];
  FromBusMessage message;
  message.status = client.status();
  const auto sent = socket_->send(place, internal::bytes_of(message));
  socket_->set_wants_to_send(place, sent == PacketSent::kFull);
  if (sent == PacketSent::kYes) client.told = message.status;
  return sent != PacketSent::kGone;
}

void BusServer::wait_until(base::Time deadline) {
  for (std::size_t place = 0; place < clients_.size(); ++place) {
    if (!socket_->taken(place) || clients_[place]->welcomed) continue;
    deadline =
        std::min(deadline, clients_[place]->came + kLongestSilence + std::chrono::milliseconds(1));
  }
  socket_->wait_until(deadline);
}

void BusServer::drop(std::size_t place) {
  socket_->drop(place);
  clients_[place]->station.close();
  clients_[place]->welcomed = false;
}

void BusServer::send_away(std::size_t place) {
  ++sent_away_;
  drop(place);
}

}  // namespace armature::can
