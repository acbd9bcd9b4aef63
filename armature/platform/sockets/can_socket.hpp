// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"

namespace armature::platform {

/// A frame as Linux has it: `id` with the flags below.
struct CanSocketFrame {
  static constexpr std::uint32_t kExtended = 0x80000000;
  static constexpr std::uint32_t kRemote = 0x40000000;
  static constexpr std::uint32_t kError = 0x20000000;

  std::uint32_t id = 0;
  std::uint8_t size = 0;
  std::array<std::uint8_t, 8> data{};
};

/// Passes the frames whose `id`, flags included, equals this one in the bits of `mask`.
struct CanSocketFilter {
  std::uint32_t id = 0;
  std::uint32_t mask = 0;
};

/// Which interface is opened, and how.
struct CanSocketRequest {
  std::string interface;                   ///< such as can0
  std::vector<CanSocketFilter> filters{};  ///< none: all frames pass
  bool own_frames = false;
  std::size_t send_capacity = 64;  ///< frames; the kernel takes it as a hint, as the next
  std::size_t receive_capacity = 256;
};

/// A raw socket of Linux's SocketCAN that never waits, with error frames and the kernel's time
/// stamps. One thread may send while another receives and a third waits.
class CanSocket {
 public:
  /// What became of a frame that was to be sent.
  enum class Sent { kYes, kQueueFull, kDown };
  /// What a look for the next frame found.
  enum class Received { kYes, kNothing, kDown };
  /// The state of the CAN controller.
  enum class Controller { kActive, kPassive, kBusOff };

  /// A frame and when it came in.
  struct Arrival {
    CanSocketFrame frame;
    base::Time time{};  ///< on the monotonic clock; never before that of the frame before
    bool own = false;
  };

  /// nullptr after an error, which names the interface and says how to mend it.
  static std::unique_ptr<CanSocket> open(const CanSocketRequest& request,
                                         base::Diagnostics& diagnostics);
  CanSocket(const CanSocket&) = delete;
  CanSocket& operator=(const CanSocket&) = delete;
  ~CanSocket();

  /// One system call that does not wait.
  Sent send(const CanSocketFrame& frame);
  /// A few system calls that do not wait.
  Received receive(Arrival& arrival);

  /// Whether the interface is, and is still the one that was opened.
  /// Two system calls that do not wait.
  bool is_up() const;
  /// How the controller was when the socket was opened; kActive if the kernel does not tell.
  Controller at_first() const { return at_first_; }

  /// Frames that the kernel had no room for until the last one that was received.
  std::uint32_t lost() const { return lost_; }

  /// Waits for frames that have not been waited for yet; false after `interrupt`.
  bool wait();
  /// Ends the present `wait`, and every later one.
  void interrupt();

 private:
  CanSocket(std::string interface, int socket, int events, int interruption)
      : interface_(std::move(interface)),
        socket_(socket),
        events_(events),
        interruption_(interruption) {}

  const std::string interface_;
  const int socket_;
  const int events_;
  const int interruption_;
  Controller at_first_ = Controller::kActive;
  std::uint32_t lost_ = 0;
  base::Time latest_{};
};

}  // namespace armature::platform
