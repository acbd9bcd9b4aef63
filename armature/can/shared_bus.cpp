// SPDX-License-Identifier: Apache-2.0
#include "armature/can/shared_bus.hpp"

#include <array>
#include <chrono>
#include <utility>

#include "armature/can/internal/shared_bus_messages.hpp"
#include "armature/can/internal/watcher.hpp"
#include "armature/platform/clock.hpp"
#include "armature/rt/guard.hpp"

namespace armature::can {
namespace {

using internal::FromBus;
using internal::FromBusMessage;
using internal::StationStatus;
using internal::ToBus;
using internal::ToBusMessage;
using platform::PacketReceived;
using platform::PacketSent;

constexpr base::Duration kPatience = std::chrono::seconds(5);
constexpr base::Duration kBetweenTries = std::chrono::milliseconds(100);

bool is_valid(const FromBusMessage& message) {
  return message.magic == internal::kSharedBusMagic &&
         message.status.state <= static_cast<std::uint32_t>(BusState::kDown);
}

bool check_sizes(const std::string& name, const BusOptions& options,
                 base::Diagnostics& diagnostics) {
  if (options.send_capacity <= internal::kMostSharedCapacity &&
      options.receive_capacity <= internal::kMostSharedCapacity &&
      options.filters.size() <= internal::kMostSharedFilters) {
    return true;
  }
  diagnostics.error({},
                    "bus '" + name + "': capacities of at most " +
                        std::to_string(internal::kMostSharedCapacity) + " frames and at most " +
                        std::to_string(internal::kMostSharedFilters) +
                        " filters are expected, but are " + std::to_string(options.send_capacity) +
                        ", " + std::to_string(options.receive_capacity) + " and " +
                        std::to_string(options.filters.size()),
                    "a bus of another process has no room for more");
  return false;
}

}  // namespace

SharedBus::SharedBus(std::string path, std::uint32_t bit_rate, platform::ThreadRequest watcher)
    : Bus("virtual:" + path),
      path_(std::move(path)),
      bit_rate_(bit_rate),
      watcher_request_(std::move(watcher)),
      told_(std::make_unique<StationStatus>()) {
  if (watcher_request_.name.empty()) watcher_request_.name = "shared-bus";
}

SharedBus::~SharedBus() { close(); }

bool SharedBus::open(const BusOptions& options, base::Diagnostics& diagnostics) {
  if (socket_ != nullptr) {
    diagnostics.error({}, "bus '" + name() + "' is open already",
                      "close it first, or give each driver a SharedBus of its own");
    return false;
  }
  if (!check_options(name(), options, diagnostics) || !check_sizes(name(), options, diagnostics)) {
    return false;
  }
  options_ = options;
  hello_ = internal::hello_of(options, bit_rate_);
  begin_anew();
  if (!connect(diagnostics)) {
    socket_.reset();
    return false;
  }
  if (options_.on_news) {
    watcher_ = internal::start_watcher(
        name(), watcher_request_, [this] { watch(); }, diagnostics);
  }
  return true;
}

bool SharedBus::connect(base::Diagnostics& diagnostics) {
  auto connected = platform::PacketSocket::connect(path_);
  if (!connected) {
    diagnostics.error({}, "bus '" + name() + "': " + connected.error(),
                      path_.empty()
                          ? std::string("name the bus by its path: virtual:/tmp/robot.bus")
                          : "start what has the bus first: armature-janus-plant --bus " + path_ +
                                ", or armature-wam-emulator --bus virtual:" + path_);
    return false;
  }
  socket_ = std::move(connected).value();
  return is_welcome(diagnostics);
}

/// Waits for the server's first packet.
bool SharedBus::is_welcome(base::Diagnostics& diagnostics) {
  const base::Time deadline = platform::monotonic_now() + kPatience;
  FromBusMessage message;
  std::size_t size = 0;
  if (socket_->send(hello_) != PacketSent::kYes || !socket_->wait_for_packet(deadline)) {
    diagnostics.error(
        {}, "bus '" + name() + "': the process that serves there does not answer",
        "resume it with SIGCONT if it is stopped; otherwise start a process that has the bus");
    return false;
  }
  const auto received = socket_->receive(std::as_writable_bytes(std::span(&message, 1)), size);
  if (received != PacketReceived::kYes || size != sizeof message || !is_valid(message) ||
      message.kind != FromBus::kWelcome) {
    diagnostics.error({}, "bus '" + name() + "': the process that serves there sends us away",
                      "all its stations are taken, or it is another version");
    return false;
  }
  note(message.status);
  return true;
}

void SharedBus::watch() {
  while (socket_->wait()) {
    options_.on_news();
    if (socket_->other_end_is_gone() && !reconnect()) return;
  }
}

/// Only once the receiver knows that the bus is down, so that nobody sends in between. False if
/// the bus is closed meanwhile.
bool SharedBus::reconnect() {
  while (socket_->pause(kBetweenTries)) {
    options_.on_news();
    if (state() != BusState::kDown || !socket_->try_reconnect()) continue;
    if (socket_->send(hello_) == PacketSent::kYes) return true;
  }
  return false;
}

void SharedBus::close() {
  if (socket_ == nullptr) return;
  socket_->interrupt();
  watcher_.reset();
  tally_.lose_unread(*this);
  internal::Tally::add(tally_.discarded, waiting());
  socket_.reset();
  state_ = BusState::kClosed;
}

std::uint64_t SharedBus::waiting() const {
  return sent_.load(std::memory_order_relaxed) - finished_.load(std::memory_order_acquire);
}

SendStatus SharedBus::send(const Frame& frame) { return tally_.answer(try_send(frame)); }

SendStatus SharedBus::try_send(const Frame& frame) {
  if (!can_be_sent(frame)) return SendStatus::kInvalid;
  const BusState now = state();
  if (now == BusState::kClosed || now == BusState::kDown) return SendStatus::kDown;
  if (now == BusState::kBusOff) return SendStatus::kBusOff;
  if (waiting() >= options_.send_capacity) return SendStatus::kQueueFull;
  const ToBusMessage message{.kind = ToBus::kFrame,
                             .unused = 0,
                             .time_ns = base::to_ns(platform::monotonic_now()),
                             .frame = internal::to_shared(frame, false)};
  const rt::PermitScope does_not_wait;
  switch (socket_->send(internal::bytes_of(message))) {
    case PacketSent::kYes:
      sent_.fetch_add(1, std::memory_order_relaxed);
      return SendStatus::kSent;
    case PacketSent::kFull:
      return SendStatus::kQueueFull;
    case PacketSent::kGone:
      break;
  }
  return SendStatus::kDown;  // which `receive` finds out, too: it says what has gone with it
}

ReceiveStatus SharedBus::receive(Arrival& arrival) {
  if (socket_ == nullptr) return ReceiveStatus::kDown;
  const rt::PermitScope does_not_wait;
  FromBusMessage message;
  std::size_t size = 0;
  while (true) {
    const auto received = socket_->receive(std::as_writable_bytes(std::span(&message, 1)), size);
    if (received == PacketReceived::kNothing) {
      return state() == BusState::kDown ? ReceiveStatus::kDown : ReceiveStatus::kNothing;
    }
    if (received == PacketReceived::kGone || size != sizeof message || !is_valid(message)) {
      lose_server();
      return ReceiveStatus::kDown;
    }
    if (take(message, arrival)) return ReceiveStatus::kReceived;
  }
}

/// False if it is no frame.
bool SharedBus::take(const FromBusMessage& message, Arrival& arrival) {
  if (message.kind == FromBus::kWelcome) begin_anew();
  note(message.status);
  if (message.kind != FromBus::kFrame) return false;
  internal::Tally::add(tally_.received);
  arrival = {internal::from_shared(message.frame), base::time_from_ns(message.time_ns),
             message.frame.own != 0};
  return true;
}

void SharedBus::begin_anew() {
  *told_ = {};
  sent_before_ = sent_.load(std::memory_order_relaxed);
}

void SharedBus::note(const StationStatus& status) {
  internal::Tally::add(tally_.discarded, status.discarded - told_->discarded);
  internal::Tally::add(tally_.lost, status.lost - told_->lost);
  internal::Tally::add(tally_.error_frames, status.error_frames - told_->error_frames);
  internal::Tally::add(tally_.bus_offs, status.bus_offs - told_->bus_offs);
  *told_ = status;
  finished_.store(sent_before_ + status.finished, std::memory_order_release);
  state_.store(static_cast<BusState>(status.state), std::memory_order_release);
}

void SharedBus::lose_server() {
  if (state_.exchange(BusState::kDown) == BusState::kDown) return;
  internal::Tally::add(tally_.discarded, waiting());
  finished_.store(sent_.load(std::memory_order_relaxed), std::memory_order_release);
}

RestartStatus SharedBus::restart() {
  if (state() != BusState::kBusOff) return RestartStatus::kNotNeeded;
  const ToBusMessage message{.kind = ToBus::kRestart,
                             .unused = 0,
                             .time_ns = base::to_ns(platform::monotonic_now()),
                             .frame = {}};
  const rt::PermitScope does_not_wait;
  socket_->send(internal::bytes_of(message));
  return RestartStatus::kRestarting;
}

}  // namespace armature::can
