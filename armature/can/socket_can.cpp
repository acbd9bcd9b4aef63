// SPDX-License-Identifier: Apache-2.0
#include "armature/can/socket_can.hpp"

#include <utility>

#include "armature/can/internal/watcher.hpp"
#include "armature/rt/guard.hpp"

namespace armature::can {
namespace {

using platform::CanSocket;
using platform::CanSocketFilter;
using platform::CanSocketFrame;

CanSocketFrame to_socket(const Frame& frame) {
  CanSocketFrame raw;
  raw.id = frame.id;
  if (frame.extended) raw.id |= CanSocketFrame::kExtended;
  if (frame.kind == FrameKind::kRemote) raw.id |= CanSocketFrame::kRemote;
  raw.size = frame.size;
  raw.data = frame.data;
  return raw;
}

Frame from_socket(const CanSocketFrame& raw) {
  Frame frame;
  frame.id = raw.id & Frame::kMostExtended;
  frame.size = raw.size;
  frame.data = raw.data;
  if ((raw.id & CanSocketFrame::kError) != 0) {
    frame.kind = FrameKind::kError;
  } else {
    frame.extended = (raw.id & CanSocketFrame::kExtended) != 0;
    if ((raw.id & CanSocketFrame::kRemote) != 0) frame.kind = FrameKind::kRemote;
  }
  return frame;
}

CanSocketFilter to_socket(const Filter& filter) {
  const std::uint32_t kind = filter.extended ? CanSocketFrame::kExtended : 0u;
  return {filter.id | kind, filter.mask | CanSocketFrame::kExtended};
}

BusState to_state(CanSocket::Controller controller) {
  switch (controller) {
    case CanSocket::Controller::kPassive:
      return BusState::kPassive;
    case CanSocket::Controller::kBusOff:
      return BusState::kBusOff;
    case CanSocket::Controller::kActive:
      break;
  }
  return BusState::kActive;
}

}  // namespace

BusState state_after(BusState before, const Frame& error_frame) {
  constexpr std::uint8_t kPassive =
      controller_problem::kReceivePassive | controller_problem::kSendPassive;
  constexpr std::uint8_t kActive = controller_problem::kReceiveWarning |
                                   controller_problem::kSendWarning |
                                   controller_problem::kActiveAgain;
  if ((error_frame.id & error_class::kBusOff) != 0) return BusState::kBusOff;
  if ((error_frame.id & error_class::kRestarted) != 0) return BusState::kActive;
  if ((error_frame.id & error_class::kController) == 0) return before;
  if ((error_frame.data[1] & kPassive) != 0) return BusState::kPassive;
  if ((error_frame.data[1] & kActive) != 0) return BusState::kActive;
  return before;
}

SocketCan::SocketCan(std::string interface, platform::ThreadRequest watcher)
    : Bus(std::move(interface)), watcher_request_(std::move(watcher)) {
  if (watcher_request_.name.empty()) watcher_request_.name = name();
}

SocketCan::~SocketCan() { close(); }

bool SocketCan::open(const BusOptions& options, base::Diagnostics& diagnostics) {
  if (socket_ != nullptr) {
    diagnostics.error({}, "bus '" + name() + "' is open already",
                      "close it first, or give each driver a SocketCan of its own");
    return false;
  }
  if (!check_options(name(), options, diagnostics)) return false;
  platform::CanSocketRequest request;
  request.interface = name();
  for (const Filter& filter : options.filters) request.filters.push_back(to_socket(filter));
  request.own_frames = options.own_frames;
  request.send_capacity = options.send_capacity;
  request.receive_capacity = options.receive_capacity;
  socket_ = CanSocket::open(request, diagnostics);
  if (socket_ == nullptr) return false;
  options_ = options;
  lost_before_ = 0;
  state_ = to_state(socket_->at_first());
  if (options_.on_news) {
    watcher_ = internal::start_watcher(
        name(), watcher_request_, [this] { watch(); }, diagnostics);
  }
  return true;
}

void SocketCan::close() {
  if (socket_ == nullptr) return;
  socket_->interrupt();
  watcher_.reset();
  tally_.lose_unread(*this);
  socket_.reset();
  state_ = BusState::kClosed;
}

void SocketCan::watch() {
  while (socket_->wait()) options_.on_news();
}

SendStatus SocketCan::send(const Frame& frame) { return tally_.answer(try_send(frame)); }

SendStatus SocketCan::try_send(const Frame& frame) {
  if (!can_be_sent(frame)) return SendStatus::kInvalid;
  if (socket_ == nullptr) return SendStatus::kDown;
  if (state() == BusState::kBusOff) return SendStatus::kBusOff;
  const rt::PermitScope does_not_wait;
  switch (socket_->send(to_socket(frame))) {
    case CanSocket::Sent::kYes:
      note_up();
      return SendStatus::kSent;
    case CanSocket::Sent::kQueueFull:
      return SendStatus::kQueueFull;
    case CanSocket::Sent::kDown:
      break;
  }
  state_ = BusState::kDown;
  return SendStatus::kDown;
}

ReceiveStatus SocketCan::receive(Arrival& arrival) {
  if (socket_ == nullptr) return ReceiveStatus::kDown;
  const rt::PermitScope does_not_wait;
  CanSocket::Arrival raw;
  while (true) {
    const auto received = socket_->receive(raw);
    if (received == CanSocket::Received::kDown) {
      state_ = BusState::kDown;
      return ReceiveStatus::kDown;
    }
    if (received == CanSocket::Received::kNothing) return nothing_came();
    note_up();
    count_lost();
    const Frame frame = from_socket(raw.frame);
    if (frame.kind == FrameKind::kError) note_error(frame);
    if (!passes(options_, frame)) continue;
    internal::Tally::add(tally_.received);
    arrival = {frame, raw.time, raw.own};
    return ReceiveStatus::kReceived;
  }
}

/// The kernel says once that the interface went down, and never that it is up again.
ReceiveStatus SocketCan::nothing_came() {
  if (state() != BusState::kDown) return ReceiveStatus::kNothing;
  if (!socket_->is_up()) return ReceiveStatus::kDown;
  note_up();
  return ReceiveStatus::kNothing;
}

void SocketCan::note_up() {
  BusState down = BusState::kDown;
  state_.compare_exchange_strong(down, BusState::kActive);
}

void SocketCan::count_lost() {
  const std::uint32_t lost = socket_->lost();
  internal::Tally::add(tally_.lost, lost - lost_before_);  // the kernel's counter may wrap around
  lost_before_ = lost;
}

void SocketCan::note_error(const Frame& frame) {
  internal::Tally::add(tally_.error_frames);
  const bool overflow = (frame.id & error_class::kController) != 0 &&
                        (frame.data[1] & controller_problem::kReceiveOverflow) != 0;
  if (overflow) internal::Tally::add(tally_.lost);  // in the controller: one at least
  const BusState before = state();
  const BusState after = state_after(before, frame);
  if (after == BusState::kBusOff && before != after) internal::Tally::add(tally_.bus_offs);
  state_ = after;
}

RestartStatus SocketCan::restart() {
  return state() == BusState::kBusOff ? RestartStatus::kNotHere : RestartStatus::kNotNeeded;
}

}  // namespace armature::can
