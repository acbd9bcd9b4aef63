// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/sockets/can_socket.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <system_error>

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/netlink.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include "armature/platform/clock.hpp"
#include "armature/platform/internal/can_state.hpp"
#include "armature/platform/internal/descriptor.hpp"
#include "armature/platform/internal/edge_events.hpp"

namespace armature::platform {
namespace {

using internal::Descriptor;

static_assert(CanSocketFrame::kExtended == CAN_EFF_FLAG &&
              CanSocketFrame::kRemote == CAN_RTR_FLAG && CanSocketFrame::kError == CAN_ERR_FLAG);
static_assert(sizeof(CanSocketFilter) == sizeof(can_filter));

/// Half of what one frame takes of a socket's buffer, a little more rather than less: the kernel
/// doubles what it is told.
constexpr int kBytesPerFrame = 512;

bool failed(const CanSocketRequest& request, const std::string& what, const std::string& hint,
            base::Diagnostics& diagnostics) {
  diagnostics.error({},
                    "CAN interface '" + request.interface + "': " + what + ": " +
                        std::generic_category().message(errno),
                    hint);
  return false;
}

template <typename Value>
bool set_option(int socket, int level, int name, const Value& value) {
  return ::setsockopt(socket, level, name, &value, sizeof value) == 0;
}

bool is_up(int socket, const std::string& interface) {
  ifreq request{};
  interface.copy(request.ifr_name, IFNAMSIZ - 1);
  return ::ioctl(socket, SIOCGIFFLAGS, &request) == 0 && (request.ifr_flags & IFF_UP) != 0;
}

bool set_filters(int socket, const std::vector<CanSocketFilter>& filters) {
  if (filters.empty()) return true;
  return ::setsockopt(socket, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                      static_cast<socklen_t>(filters.size() * sizeof(CanSocketFilter))) == 0;
}

/// Less room than asked for is no error: what does not fit is counted.
void set_buffers(int socket, const CanSocketRequest& request) {
  const auto bytes = [](std::size_t frames) {
    return static_cast<int>(std::min<std::size_t>(frames, 1 << 20)) * kBytesPerFrame;
  };
  set_option(socket, SOL_SOCKET, SO_SNDBUF, bytes(request.send_capacity));
  if (!set_option(socket, SOL_SOCKET, SO_RCVBUFFORCE, bytes(request.receive_capacity))) {
    set_option(socket, SOL_SOCKET, SO_RCVBUF, bytes(request.receive_capacity));
  }
}

bool configure(int socket, const CanSocketRequest& request, base::Diagnostics& diagnostics) {
  constexpr can_err_mask_t kAllErrors = CAN_ERR_MASK;
  const int own_frames = request.own_frames ? 1 : 0;
  if (!set_filters(socket, request.filters)) {
    return failed(request, "the kernel refuses the filters", "use at most 512", diagnostics);
  }
  if (!set_option(socket, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, kAllErrors) ||
      !set_option(socket, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, own_frames) ||
      !set_option(socket, SOL_SOCKET, SO_TIMESTAMPNS, 1) ||
      !set_option(socket, SOL_SOCKET, SO_RXQ_OVFL, 1)) {
    return failed(request, "the kernel refuses an option of the socket",
                  "Linux 3.0 or later is expected", diagnostics);
  }
  set_buffers(socket, request);
  return true;
}

bool bind_to_interface(int socket, const CanSocketRequest& request,
                       base::Diagnostics& diagnostics) {
  const unsigned index = ::if_nametoindex(request.interface.c_str());
  if (index == 0) {
    return failed(
        request, "this interface does not exist",
        "list them with 'ip link'; create a virtual one with 'ip link add vcan0 type vcan'",
        diagnostics);
  }
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(index);
  if (::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return failed(request, "is of another type", "use an interface of type can or vcan",
                  diagnostics);
  }
  if (is_up(socket, request.interface)) return true;
  errno = ENETDOWN;
  return failed(request, "cannot be used yet",
                "bring it up with 'ip link set " + request.interface +
                    " up', for hardware with 'type can bitrate 1000000'",
                diagnostics);
}

/// Error frames tell only of changes.
CanSocket::Controller controller_now(const std::string& interface) {
  switch (
      internal::can_state(::if_nametoindex(interface.c_str())).value_or(CAN_STATE_ERROR_ACTIVE)) {
    case CAN_STATE_ERROR_PASSIVE:
      return CanSocket::Controller::kPassive;
    case CAN_STATE_BUS_OFF:
      return CanSocket::Controller::kBusOff;
    default:
      return CanSocket::Controller::kActive;
  }
}

base::Time from_timespec(const timespec& time) {
  return base::time_from_ns(std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec);
}

/// What to add to the wall clock for the monotonic one. A thread that is interrupted while it reads
/// them reads them again: the interruption would pass for a difference.
base::Duration wall_to_monotonic() {
  constexpr base::Duration kUninterrupted = std::chrono::microseconds(2);
  constexpr int kMostTries = 4;
  base::Duration narrowest = base::Duration::max();
  base::Duration result{};
  for (int i = 0; i < kMostTries && narrowest > kUninterrupted; ++i) {
    const base::Time before = monotonic_now();
    timespec wall{};
    ::clock_gettime(CLOCK_REALTIME, &wall);
    const base::Duration width = monotonic_now() - before;
    if (width >= narrowest) continue;
    narrowest = width;
    result = before - from_timespec(wall);
  }
  return result;
}

/// The kernel stamps with the wall clock. A step of that since the frame came in makes nonsense of
/// the stamp; then the frame came just now.
base::Time on_monotonic_clock(const timespec& stamp) {
  constexpr base::Duration kOldest = std::chrono::seconds(10);
  const base::Time time = from_timespec(stamp) + wall_to_monotonic();
  const base::Time now = monotonic_now();
  return time <= now && time >= now - kOldest ? time : now;
}

}  // namespace

std::unique_ptr<CanSocket> CanSocket::open(const CanSocketRequest& request,
                                           base::Diagnostics& diagnostics) {
  Descriptor socket(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  if (socket.get() < 0) {
    failed(request, "the kernel gives no CAN socket",
           "load the module with 'modprobe can-raw', or use a virtual bus", diagnostics);
    return nullptr;
  }
  if (!configure(socket.get(), request, diagnostics) ||
      !bind_to_interface(socket.get(), request, diagnostics)) {
    return nullptr;
  }
  Descriptor events(::epoll_create1(EPOLL_CLOEXEC));
  Descriptor interruption(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  // Edge-triggered: told once of what has come in, whether it is received at once or not.
  if (!internal::add_event(events.get(), socket.get(), EPOLLIN | EPOLLET) ||
      !internal::add_event(events.get(), interruption.get(), EPOLLIN)) {
    failed(request, "cannot be watched for data", "close other files", diagnostics);
    return nullptr;
  }
  std::unique_ptr<CanSocket> made(
      new CanSocket(request.interface, socket.release(), events.release(), interruption.release()));
  made->at_first_ = controller_now(request.interface);
  return made;
}

CanSocket::~CanSocket() {
  ::close(socket_);
  ::close(events_);
  ::close(interruption_);
}

CanSocket::Sent CanSocket::send(const CanSocketFrame& frame) {
  can_frame raw{};
  raw.can_id = frame.id;
  raw.can_dlc = frame.size;
  std::ranges::copy(frame.data, raw.data);
  if (::send(socket_, &raw, sizeof raw, MSG_DONTWAIT) == sizeof raw) return Sent::kYes;
  const bool full = errno == EAGAIN || errno == ENOBUFS || errno == EINTR;
  return full ? Sent::kQueueFull : Sent::kDown;
}

CanSocket::Received CanSocket::receive(Arrival& arrival) {
  can_frame raw{};
  iovec content{&raw, sizeof raw};
  alignas(cmsghdr) char control[128];
  msghdr message{};
  message.msg_iov = &content;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  const ssize_t size = ::recvmsg(socket_, &message, MSG_DONTWAIT);
  if (size < 0) return errno == EAGAIN || errno == EINTR ? Received::kNothing : Received::kDown;
  if (size != sizeof raw) return Received::kNothing;

  arrival.frame.id = raw.can_id;
  arrival.frame.size = std::min<std::uint8_t>(raw.can_dlc, CAN_MAX_DLEN);
  std::ranges::copy(raw.data, arrival.frame.data.begin());
  arrival.own = (message.msg_flags & MSG_CONFIRM) != 0;
  base::Time time = monotonic_now();
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part != nullptr;
       part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET) continue;
    if (part->cmsg_type == SO_RXQ_OVFL) std::memcpy(&lost_, CMSG_DATA(part), sizeof lost_);
    if (part->cmsg_type != SO_TIMESTAMPNS) continue;
    timespec stamp{};
    std::memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
    time = on_monotonic_clock(stamp);
  }
  arrival.time = latest_ = std::max(time, latest_);
  return Received::kYes;
}

bool CanSocket::is_up() const {
  sockaddr_can address{};
  socklen_t size = sizeof address;
  // The kernel unbinds a socket whose interface was removed, also if another gets its name.
  return ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) == 0 &&
         address.can_ifindex != 0 && platform::is_up(socket_, interface_);
}

bool CanSocket::wait() { return internal::wait_for_events(events_, interruption_); }

void CanSocket::interrupt() { internal::interrupt_events(interruption_); }

}  // namespace armature::platform
