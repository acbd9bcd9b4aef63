// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "armature/can/bus.hpp"
#include "armature/can/internal/tally.hpp"
#include "armature/platform/sockets/can_socket.hpp"
#include "armature/platform/thread.hpp"

namespace armature::can {

/// A CAN interface of Linux, such as can0 or vcan0; times are the kernel's, on the monotonic clock.
///
/// The state is that of the last `receive`, or of `open`: it comes with error frames. Lost frames
/// are counted with the next one that is received. More may wait to be sent than `send_capacity`,
/// by half and by a handful at least, but not more than the interface allows (its txqueuelen).
/// What waits in the kernel when the bus goes off or the interface down is thrown away and not
/// counted; when the bus is closed it still goes out. After bus-off the system restarts the
/// interface if it was told to (`ip link set can0 type can restart-ms 1000`); `restart` cannot. An
/// interface that is up again is used again; one that was removed has to be opened again. See
/// docs/can.md.
class SocketCan final : public Bus {
 public:
  /// @param interface  the bus's name
  /// @param watcher    how the thread that calls `on_news` is to run; there is none without it
  explicit SocketCan(std::string interface, platform::ThreadRequest watcher = {});
  ~SocketCan() override;

  bool open(const BusOptions& options, base::Diagnostics& diagnostics) override;
  void close() override;
  SendStatus send(const Frame& frame) override;
  ReceiveStatus receive(Arrival& arrival) override;
  BusState state() const override { return state_.load(std::memory_order_acquire); }
  RestartStatus restart() override;
  BusCounters counters() const override { return tally_.now(); }

 private:
  SendStatus try_send(const Frame& frame);
  ReceiveStatus nothing_came();
  void count_lost();
  void note_error(const Frame& frame);
  void note_up();
  void watch();

  platform::ThreadRequest watcher_request_;
  BusOptions options_;
  internal::Tally tally_;
  std::atomic<BusState> state_{BusState::kClosed};
  std::unique_ptr<platform::CanSocket> socket_;
  std::unique_ptr<platform::Thread> watcher_;
  std::uint32_t lost_before_ = 0;
};

/// The state after an error frame in the coding of Linux, `before` if it says nothing of it.
BusState state_after(BusState before, const Frame& error_frame);

}  // namespace armature::can
