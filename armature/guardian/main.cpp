// SPDX-License-Identifier: Apache-2.0
// The guardian: a process that switches drives off when the one that controls them cannot. It has
// no library but libc, which is part of it, allocates nothing, and sends what its orders have and
// nothing else.
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <ctime>

#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include "armature/guardian/internal/page.hpp"
#include "armature/guardian/internal/watch.hpp"

namespace armature::guardian::internal {
namespace {

constexpr int kFailed = 1;
constexpr int kWrongUse = 2;

std::int64_t now_ns() {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

// ---- What it says

/// A line, of pieces. It is lost where it would have to be waited for.
class Line {
 public:
  Line& add(const char* text) {
    while (*text != '\0' && size_ + 1 < sizeof text_) text_[size_++] = *text++;
    return *this;
  }
  Line& add(std::int64_t number) {
    char digits[24];
    std::size_t count = 0;
    do {
      digits[count++] = static_cast<char>('0' + number % 10);
      number /= 10;
    } while (number > 0);
    while (count > 0 && size_ + 1 < sizeof text_) text_[size_++] = digits[--count];
    return *this;
  }
  void say() {
    text_[size_++] = '\n';
    pollfd stream{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
    if (::poll(&stream, 1, 0) != 1 || (stream.revents & POLLOUT) == 0) return;
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text_, size_);
  }

 private:
  char text_[256];
  std::size_t size_ = 0;
};

// ---- Its own way to the bus

class Bus {
 public:
  static constexpr std::size_t kMostReceived = 128;

  explicit Bus(const Orders& orders) : orders_(orders) {}

  /// False with errno.
  bool open() {
    close();
    const bool opened = orders_.way == Way::kSocketFile ? open_socket_file() : open_interface();
    if (opened && orders_.hello.size > 0) send(orders_.hello);
    if (!opened) close();
    return opened;
  }
  bool is_open() const { return socket_ >= 0; }

  void send(const Packet& packet) {
    Packet dated = packet;
    const std::int64_t now = now_ns();
    const PacketLayout& layout = orders_.layout;
    if (layout.time != kNowhere && &packet != &orders_.hello) {
      std::memcpy(dated.bytes + layout.time, &now, sizeof now);
    }
    const ssize_t sent = ::send(socket_, dated.bytes, dated.size, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent < 0 && (errno == EPIPE || errno == ECONNRESET || errno == ENOTCONN)) close();
  }

  /// False if there is none.
  bool receive(std::uint8_t (&room)[kMostReceived]) {
    for (;;) {
      const ssize_t size = ::recv(socket_, room, sizeof room, MSG_DONTWAIT | MSG_TRUNC);
      if (size == 0) close();
      if (size <= 0) return false;
      if (size == orders_.layout.size) return true;
    }
  }

 private:
  void close() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
  }

  bool open_socket_file() {
    socket_ = ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    static_assert(sizeof address.sun_path >= sizeof orders_.address);
    std::memcpy(address.sun_path, orders_.address, sizeof orders_.address);
    return ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }

  bool open_interface() {
    socket_ = ::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
    if (socket_ < 0) return false;
    const can_filter filter{orders_.filter_id, orders_.filter_mask | CAN_EFF_FLAG | CAN_RTR_FLAG};
    ::setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_FILTER, &filter, sizeof filter);
    ifreq request{};
    std::memcpy(request.ifr_name, orders_.address, IFNAMSIZ - 1);
    if (::ioctl(socket_, SIOCGIFINDEX, &request) != 0) return false;
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = request.ifr_ifindex;
    return ::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }

  const Orders& orders_;
  int socket_ = -1;
};

// ---- The guardian

class Guardian {
 public:
  Guardian(Page& page, const Orders& orders, int process)
      : page_(page), orders_(orders), process_(process), bus_(orders), watch_(orders.period_ns) {}

  bool connect() { return bus_.open(); }

  int run() {
    for (;;) {
      take_answers();
      const Act act = watch_.look(sight());
      if (act == Act::kSend) send_all();
      if (act == Act::kEnd) return end();
      if (act == Act::kGiveUp) return give_up();
      page_.alive_ns.store(now_ns(), std::memory_order_relaxed);
      sleep_until(watch_.next());
    }
  }

 private:
  Sight sight() const {
    Sight sight;
    sight.dead = dead_;
    sight.ended = page_.ended.load(std::memory_order_acquire) != 0;
    sight.watched = page_.watched.load(std::memory_order_acquire) != 0;
    sight.acknowledged = page_.acknowledged.load(std::memory_order_acquire);
    sight.beat = page_.beat_ns.load(std::memory_order_relaxed);
    sight.idle = orders_.device_count > 0 && idle_devices_ == all_devices();
    sight.bus = bus_.is_open();
    sight.now = now_ns();
    return sight;
  }

  std::uint64_t all_devices() const { return (std::uint64_t{1} << orders_.device_count) - 1; }

  /// First what has to be done, then what there is to say of it.
  void send_all() {
    if (!bus_.is_open() && now_ns() >= connect_at_) {
      connect_at_ = now_ns() + kBetweenTries;
      bus_.open();
    }
    const bool first = watch_.acted() != page_.acted.load(std::memory_order_relaxed);
    const bool died = watch_.cause() == Cause::kDeath && !said_death_;
    if (first || died) idle_devices_ = 0;
    for (std::size_t i = 0; i < orders_.safe_count && bus_.is_open(); ++i) {
      bus_.send(orders_.safe[i]);
    }
    for (std::size_t i = 0; i < orders_.question_count && bus_.is_open(); ++i) {
      bus_.send(orders_.questions[i]);
    }
    if (first) {
      page_.silent_ns.store(watch_.silence(), std::memory_order_relaxed);
      page_.acted.store(watch_.acted(), std::memory_order_release);
    }
    if (first || died) say_why();
  }

  void say_why() {
    said_death_ = watch_.cause() == Cause::kDeath;
    Line line;
    line.add("armature-guardian: process ").add(std::int64_t{orders_.process});
    if (said_death_) {
      line.add(" has died");
    } else {
      line.add(" has run no cycle for ").add(watch_.silence() / kMillisecond).add(" ms");
    }
    line.add(bus_.is_open() ? "; switches the drives off on " : "; cannot reach the bus ")
        .add(orders_.address)
        .say();
  }

  void take_answers() {
    std::uint8_t packet[Bus::kMostReceived];
    while (bus_.is_open() && bus_.receive(packet)) take(packet);
  }

  void take(const std::uint8_t* packet) {
    const PacketLayout& layout = orders_.layout;
    std::uint32_t word = 0;
    if (layout.kind != kNowhere) {
      std::memcpy(&word, packet + layout.kind, sizeof word);
      if (word != layout.frame) return;
    }
    if (layout.extended != kNowhere && packet[layout.extended] != 0) return;
    std::memcpy(&word, packet + layout.id, sizeof word);
    for (std::size_t i = 0; i < orders_.answer_count; ++i) {
      const IdleAnswer& answer = orders_.answers[i];
      if (answer.id == word && matches(answer, packet + layout.data)) {
        idle_devices_ |= std::uint64_t{1} << answer.device;
      }
    }
  }

  static bool matches(const IdleAnswer& answer, const std::uint8_t* data) {
    for (std::size_t i = 0; i < sizeof answer.mask; ++i) {
      if (((data[i] ^ answer.value[i]) & answer.mask[i]) != 0) return false;
    }
    return true;
  }

  /// The end of the process ends it at once.
  void sleep_until(std::int64_t time) {
    const std::int64_t left = time - now_ns();
    if (left <= 0) return;
    timespec timeout{};
    timeout.tv_sec = static_cast<time_t>(left / 1'000'000'000);
    timeout.tv_nsec = static_cast<long>(left % 1'000'000'000);
    pollfd process{.fd = dead_ ? -1 : process_, .events = POLLIN, .revents = 0};
    if (::ppoll(&process, 1, &timeout, nullptr) == 1) dead_ = true;
  }

  int end() const {
    if (!dead_ || watch_.cause() == Cause::kNone) return 0;
    Line().add("armature-guardian: the drives on ").add(orders_.address).add(" are idle").say();
    return 0;
  }
  int give_up() const {
    Line()
        .add("armature-guardian: the drives on ")
        .add(orders_.address)
        .add(bus_.is_open() ? " do not say that they are idle: press E-stop"
                            : " cannot be reached: press E-stop")
        .say();
    return kFailed;
  }

  static constexpr std::int64_t kBetweenTries = 100 * kMillisecond;

  Page& page_;
  const Orders& orders_;
  const int process_;
  Bus bus_;
  Watch watch_;
  std::uint64_t idle_devices_ = 0;
  std::int64_t connect_at_ = 0;
  bool dead_ = false;
  bool said_death_ = false;
};

// ---- Its start

bool are_possible(const Orders& orders) {
  const PacketLayout& layout = orders.layout;
  const auto in_packet = [&](std::uint16_t place, std::size_t size) {
    return place == kNowhere || place + size <= layout.size;
  };
  bool good = orders.magic == kPageMagic && orders.version == kPageVersion &&
              orders.period_ns > 0 && orders.safe_count > 0 && orders.safe_count <= kMostSafe &&
              orders.question_count <= kMostQuestions && orders.answer_count <= kMostAnswers &&
              orders.device_count <= kMostDevices && layout.size <= Bus::kMostReceived &&
              in_packet(layout.kind, 4) && in_packet(layout.id, 4) && in_packet(layout.data, 8) &&
              in_packet(layout.extended, 1) && orders.hello.size <= kMostPacket &&
              orders.address[sizeof orders.address - 1] == '\0';
  const auto is_packet = [&](const Packet& packet) {
    return packet.size <= kMostPacket &&
           (layout.time == kNowhere || layout.time + sizeof(std::int64_t) <= packet.size);
  };
  for (std::size_t i = 0; good && i < orders.safe_count; ++i) good = is_packet(orders.safe[i]);
  for (std::size_t i = 0; good && i < orders.question_count; ++i) {
    good = is_packet(orders.questions[i]);
  }
  for (std::size_t i = 0; good && i < orders.answer_count; ++i) {
    good = orders.answers[i].device < orders.device_count;
  }
  return good;
}

/// What is meant for the process that it guards is not for it: a terminal's Ctrl-C, a signal to
/// all.
void ignore_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT, SIGXFSZ, SIGTSTP, SIGTTOU,
                           SIGTTIN, SIGUSR1, SIGUSR2, SIGALRM}) {
    ::signal(signal, SIG_IGN);
  }
}

/// What the system does not grant is not there; the process tells it.
void become_urgent(Page& page) {
  constexpr int kMostUrgent = 99;
  ::prctl(PR_SET_NAME, "guardian");
  ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  page.locked = ::mlockall(MCL_CURRENT | MCL_FUTURE) == 0 ? 1 : 0;
  sched_param parameters{};
  parameters.sched_priority = kMostUrgent;
  page.urgent = ::sched_setscheduler(0, SCHED_FIFO, &parameters) == 0 ? 1 : 0;
  if (page.urgent == 0) ::setpriority(PRIO_PROCESS, 0, -20);
  // Without memory, others go first.
  const int file = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  [[maybe_unused]] const ssize_t written = ::write(file, "-1000", 5);
  ::close(file);
}

int guard() {
  void* const mapped =
      ::mmap(nullptr, sizeof(Page), PROT_READ | PROT_WRITE, MAP_SHARED, kPageDescriptor, 0);
  if (mapped == MAP_FAILED) {
    Line().add("armature-guardian: is a part of armature run; do not start it by hand").say();
    return kWrongUse;
  }
  Page& page = *static_cast<Page*>(mapped);
  static Orders orders;
  orders = page.orders;
  if (!are_possible(orders)) return kWrongUse;
  ignore_signals();
  become_urgent(page);
  const int process = static_cast<int>(::syscall(SYS_pidfd_open, orders.process, 0U));
  if (process < 0 || ::getppid() != orders.process) {
    page.stage = Stage::kNoProcess;
    return kFailed;
  }
  static Guardian guardian(page, orders, process);
  if (!guardian.connect()) {
    page.error = errno;
    page.stage = Stage::kNoBus;
    return kFailed;
  }
  page.alive_ns = now_ns();
  page.stage.store(Stage::kReady, std::memory_order_release);
  return guardian.run();
}

}  // namespace
}  // namespace armature::guardian::internal

int main() { return armature::guardian::internal::guard(); }
