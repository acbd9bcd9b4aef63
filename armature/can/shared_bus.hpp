// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "armature/can/bus.hpp"
#include "armature/can/internal/tally.hpp"
#include "armature/platform/sockets/packet_socket.hpp"
#include "armature/platform/thread.hpp"

namespace armature::can::internal {
struct FromBusMessage;
struct StationStatus;
}  // namespace armature::can::internal

namespace armature::can {

/// A station on the virtual bus of another process of this machine, which has a `BusServer`; times
/// are those of the frames' ends on that bus, on the monotonic clock.
///
/// The state is that of the last `receive`: what the server tells comes with it. When the server
/// has gone the bus is down and what waited thrown away; the thread that calls `on_news` looks ten
/// times a second whether there is one again, and then the station begins anew. A frame that a
/// server gets to see more than 100 ms after it was sent, because it was stopped meanwhile, is
/// discarded. See docs/can.md.
class SharedBus final : public Bus {
 public:
  /// @param path      the server's socket file; the bus's name is `virtual:` and the path
  /// @param bit_rate  of this station; with another than the bus's it understands nothing, as on a
  ///                  wire
  /// @param watcher   how the thread that calls `on_news` is to run; there is none without it
  SharedBus(std::string path, std::uint32_t bit_rate, platform::ThreadRequest watcher = {});
  ~SharedBus() override;

  bool open(const BusOptions& options, base::Diagnostics& diagnostics) override;
  void close() override;
  SendStatus send(const Frame& frame) override;
  ReceiveStatus receive(Arrival& arrival) override;
  BusState state() const override { return state_.load(std::memory_order_acquire); }
  RestartStatus restart() override;
  BusCounters counters() const override { return tally_.now(); }

 private:
  bool connect(base::Diagnostics& diagnostics);
  bool is_welcome(base::Diagnostics& diagnostics);
  void watch();
  bool reconnect();
  SendStatus try_send(const Frame& frame);
  bool take(const internal::FromBusMessage& message, Arrival& arrival);
  void note(const internal::StationStatus& status);
  void begin_anew();
  void lose_server();
  std::uint64_t waiting() const;

  const std::string path_;
  const std::uint32_t bit_rate_;
  platform::ThreadRequest watcher_request_;
  BusOptions options_;
  std::vector<std::byte> hello_;
  internal::Tally tally_;
  std::atomic<BusState> state_{BusState::kClosed};
  std::unique_ptr<platform::PacketSocket> socket_;
  std::unique_ptr<platform::Thread> watcher_;

  std::atomic<std::uint64_t> sent_{0};
  std::atomic<std::uint64_t> finished_{0};  ///< of these, those that wait no more
  std::uint64_t sent_before_ = 0;           ///< to servers that have gone
  std::unique_ptr<internal::StationStatus> told_;
};

}  // namespace armature::can
