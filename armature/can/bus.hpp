// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/can/frame.hpp"

namespace armature::can {

/// Lets through the frames of its kind whose identifier equals `id` in the bits of `mask`.
struct Filter {
  std::uint32_t id = 0;
  std::uint32_t mask = Frame::kMostStandard;
  bool extended = false;

  constexpr bool passes(const Frame& frame) const {
    return frame.extended == extended && ((frame.id ^ id) & mask) == 0;
  }
};

/// What a driver asks of a bus when it opens it.
struct BusOptions {
  std::vector<Filter> filters{};       ///< a frame passes if any lets it; none: all pass
  std::size_t send_capacity = 64;      ///< frames that may wait to be sent
  std::size_t receive_capacity = 256;  ///< frames that may wait to be received
  bool own_frames = false;             ///< receive what was sent here, too, once it was on the wire
  bool error_frames = false;           ///< receive error frames, too; filters do not concern them
  /// Called after frames have come in or the state has changed: to notify an rt::Wakeup or to post
  /// to a component. Runs in the bus's own thread, so it must neither wait nor open or close a bus.
  std::function<void()> on_news{};
};

/// What became of a frame that was to be sent.
enum class SendStatus {
  kSent,       ///< taken: it waits for the bus or is on it
  kQueueFull,  ///< not taken: `send_capacity` frames wait already
  kBusOff,     ///< not taken: see `Bus::restart`
  kDown,       ///< not taken: the bus is closed, or its interface is down
  kInvalid,    ///< not taken: no controller can send such a frame (see `can_be_sent`)
};

/// What a look for the next frame found; kDown: the bus is closed, or its interface is down.
enum class ReceiveStatus { kReceived, kNothing, kDown };

/// A frame and when its last bit came in, on the application's clock.
struct Arrival {
  Frame frame;
  base::Time time{};
  bool own = false;  ///< was sent here
};

/// Of the controller, as the rules of CAN have it.
enum class BusState {
  kClosed,
  kActive,
  kPassive,  ///< many errors: it may no longer stop others' frames
  kBusOff,   ///< so many errors of its own that it may not send; needs a restart
  kDown,     ///< the interface is down or gone
};

/// What became of a restart after bus-off.
enum class RestartStatus {
  kRestarting,  ///< the state becomes kActive when the bus has been quiet long enough
  kNotNeeded,   ///< it is not bus-off
  kNotHere,     ///< only the system's administrator can, see the bus's class
};

/// What happened since the bus was made; nothing is lost without being counted here.
struct BusCounters {
  std::uint64_t sent = 0;          ///< frames that `send` took
  std::uint64_t refused = 0;       ///< frames that `send` did not take, for whatever reason
  std::uint64_t discarded = 0;     ///< taken, but thrown away before they were sent
  std::uint64_t received = 0;      ///< frames that came in, passed the filters and had room
  std::uint64_t lost = 0;          ///< frames that should have been received: no room, or a fault
  std::uint64_t error_frames = 0;  ///< seen on the bus or told by the controller
  std::uint64_t bus_offs = 0;

  friend bool operator==(const BusCounters&, const BusCounters&) = default;
};

const char* to_text(SendStatus status);
const char* to_text(BusState state);

/// One station on a CAN bus: what drivers are written against.
///
/// One thread sends and one receives, which may be the same; `state` and `counters` are for any.
/// Frames are received in the order of the bus. When a bus goes bus-off or is closed, the frames
/// that wait to be sent are discarded: a command must not come out later, when nobody expects it.
class Bus {
 public:
  explicit Bus(std::string name) : name_(std::move(name)) {}
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;
  virtual ~Bus() = default;

  const std::string& name() const { return name_; }

  /// Gets ready to send and receive; frames that came before are not received.
  /// @return false after an error, each named in `diagnostics`; the bus is closed then
  /// @thread not while another thread uses the bus
  virtual bool open(const BusOptions& options, base::Diagnostics& diagnostics) = 0;

  /// Frames that wait, to be sent or received, are discarded and counted; closing twice is allowed.
  /// @thread not while another thread uses the bus
  virtual void close() = 0;

  /// @rt nonblocking, no allocation
  /// @thread the sender only
  virtual SendStatus send(const Frame& frame) = 0;

  /// The oldest frame that waits; leaves `arrival` alone if there is none.
  /// @rt nonblocking, no allocation
  /// @thread the receiver only
  virtual ReceiveStatus receive(Arrival& arrival) = 0;

  /// @rt nonblocking
  virtual BusState state() const = 0;

  /// Asks to come back after bus-off.
  /// @rt nonblocking, no allocation
  /// @thread the sender only
  virtual RestartStatus restart() = 0;

  /// @rt nonblocking
  virtual BusCounters counters() const = 0;

 private:
  const std::string name_;
};

/// Reports what is wrong with `options` for the bus `name`; for implementations of `Bus::open`.
bool check_options(const std::string& name, const BusOptions& options,
                   base::Diagnostics& diagnostics);

/// Whether any of the filters lets the frame through, or there are none; error frames pass if
/// `options` asks for them.
/// @rt nonblocking, no allocation, O(filters)
bool passes(const BusOptions& options, const Frame& frame);

}  // namespace armature::can
