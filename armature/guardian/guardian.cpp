// SPDX-License-Identifier: Apache-2.0
#include "armature/guardian/guardian.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "armature/can/packets.hpp"
#include "armature/guardian/internal/page.hpp"
#include "armature/platform/clock.hpp"
#include "armature/platform/elf/shared_object.hpp"

namespace armature::guardian {
namespace {

using internal::Page;
using internal::Stage;

constexpr const char* kProgram = "armature-guardian";
constexpr base::Duration kStartTime = std::chrono::seconds(2);
constexpr base::Duration kEndTime = std::chrono::milliseconds(500);
/// The guardian looks every 50 ms at least.
constexpr base::Duration kLongestSilence = std::chrono::milliseconds(500);

std::string why(int error) { return std::generic_category().message(error); }

std::string packet_problem(const std::string& what, std::size_t count, std::size_t most) {
  return std::to_string(count) + " " + what + ", expected at most " + std::to_string(most);
}

// ---- The orders, as they are in the page

internal::Packet packet_of(const can::Packets::Bytes& bytes) {
  internal::Packet packet;
  packet.size = static_cast<std::uint16_t>(bytes.size());
  std::memcpy(packet.bytes, bytes.data(), std::min(bytes.size(), sizeof packet.bytes));
  return packet;
}

std::uint16_t place(const std::optional<std::size_t>& place) {
  return place ? static_cast<std::uint16_t>(*place) : internal::kNowhere;
}

internal::PacketLayout layout_of(const can::Packets& packets) {
  internal::PacketLayout layout;
  layout.time = place(packets.time_sent);
  layout.size = static_cast<std::uint16_t>(packets.size);
  layout.kind = place(packets.kind);
  layout.frame = packets.frame_kind;
  layout.id = place(packets.id);
  layout.extended = place(packets.extended);
  layout.data = place(packets.data);
  return layout;
}

void write_orders(const Orders& orders, internal::Orders& page) {
  const auto packets = can::Packets::of(orders.bus, orders.bit_rate, orders.answers_filter);
  page.process = ::getpid();
  page.way = packets.socket_file ? internal::Way::kSocketFile : internal::Way::kInterface;
  packets.address.copy(page.address, sizeof page.address - 1);
  page.filter_id = orders.answers_filter.id;
  page.filter_mask = orders.answers_filter.mask;
  page.period_ns = orders.period.count();
  page.hello = packet_of(packets.hello);
  page.layout = layout_of(packets);
  for (const can::Frame& frame : orders.safe) {
    page.safe[page.safe_count++] = packet_of(packets.to_send(frame));
  }
  for (const can::Frame& frame : orders.questions) {
    page.questions[page.question_count++] = packet_of(packets.to_send(frame));
  }
  for (const IdleAnswer& answer : orders.answers) {
    internal::IdleAnswer& written = page.answers[page.answer_count++];
    written.device = static_cast<std::uint32_t>(answer.device);
    written.id = answer.frame.id;
    std::ranges::copy(answer.mask, written.mask);
    std::ranges::copy(answer.frame.data, written.value);
    page.device_count = std::max(page.device_count, written.device + 1);
  }
}

// ---- The process

/// Beside this library, or where programs are that are installed with it.
std::string program_path() {
  const auto* const here = reinterpret_cast<const void*>(&problem_of);
  for (const std::string& name : {std::string(kProgram), std::string("../bin/") + kProgram,
                                  std::string("../../bin/") + kProgram}) {
    std::string path = platform::file_beside(here, name);
    if (::access(path.c_str(), X_OK) == 0) return path;
  }
  return {};
}

/// A session of its own: what ends the terminal's processes does not end it.
base::Result<int> spawn(const std::string& path, int page) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, page, internal::kPageDescriptor);
  posix_spawn_file_actions_addclosefrom_np(&files, internal::kPageDescriptor + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
  std::string name = kProgram;
  char* const arguments[] = {name.data(), nullptr};
  char* const environment[] = {nullptr};
  pid_t process = 0;
  const int error =
      ::posix_spawn(&process, path.c_str(), &files, &attributes, arguments, environment);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) return base::Error{path + " cannot be started: " + why(error)};
  return static_cast<int>(process);
}

bool has_ended(int process) { return ::waitpid(process, nullptr, WNOHANG) != 0; }

/// Empty once it is ready.
std::string wait_until_ready(const Page& page, int process, const std::string& bus) {
  const base::Time deadline = platform::monotonic_now() + kStartTime;
  while (platform::monotonic_now() < deadline) {
    const Stage stage = page.stage.load(std::memory_order_acquire);
    if (stage == Stage::kReady) return {};
    if (stage == Stage::kNoBus) return "it cannot reach the bus '" + bus + "': " + why(page.error);
    if (stage == Stage::kNoProcess)
      return "it cannot watch this process: the kernel is older than 5.3";
    if (has_ended(process)) return "it ended at once";
    platform::sleep_until(platform::monotonic_now() + std::chrono::milliseconds(1));
  }
  return "it was not ready within 2 s";
}

void wait_for_end(int process, base::Duration limit) {
  const base::Time deadline = platform::monotonic_now() + limit;
  while (!has_ended(process) && platform::monotonic_now() < deadline) {
    platform::sleep_until(platform::monotonic_now() + std::chrono::milliseconds(1));
  }
}

/// The page is shared by both and by nobody else.
Page* make_page(int& descriptor) {
  descriptor = ::memfd_create("armature-guardian", MFD_CLOEXEC);
  if (descriptor < 0 || ::ftruncate(descriptor, sizeof(Page)) != 0) return nullptr;
  void* const mapped =
      ::mmap(nullptr, sizeof(Page), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  return mapped == MAP_FAILED ? nullptr : new (mapped) Page;
}

}  // namespace

std::string problem_of(const Orders& orders) {
  const auto packets = can::Packets::of(orders.bus, orders.bit_rate, orders.answers_filter);
  if (packets.address.size() >= sizeof(internal::Orders::address))
    return "the bus's name is too long";
  if (orders.period <= base::Duration{}) return "the period is not above 0";
  if (orders.safe.empty()) return "no frame to switch the drives off is given";
  if (orders.safe.size() > internal::kMostSafe) {
    return packet_problem("frames that switch off", orders.safe.size(), internal::kMostSafe);
  }
  if (orders.questions.size() > internal::kMostQuestions) {
    return packet_problem("questions", orders.questions.size(), internal::kMostQuestions);
  }
  if (orders.answers.size() > internal::kMostAnswers) {
    return packet_problem("answers", orders.answers.size(), internal::kMostAnswers);
  }
  const auto is_plain = [](const can::Frame& frame) {
    return can_be_sent(frame) && !frame.extended && frame.kind == can::FrameKind::kData;
  };
  if (!std::ranges::all_of(orders.safe, is_plain) ||
      !std::ranges::all_of(orders.questions, is_plain)) {
    return "a frame must have an identifier of 11 bits and data";
  }
  for (const IdleAnswer& answer : orders.answers) {
    if (answer.device >= internal::kMostDevices) {
      return packet_problem("devices", answer.device + 1, internal::kMostDevices);
    }
    if (!orders.answers_filter.passes(answer.frame)) return "an answer does not pass the filter";
  }
  return {};
}

base::Result<std::unique_ptr<Guardian>> Guardian::start(const Orders& orders) {
  if (const std::string problem = problem_of(orders); !problem.empty()) return base::Error{problem};
  const std::string path = program_path();
  if (path.empty()) {
    return base::Error{std::string(kProgram) + " is missing beside the program armature"};
  }
  int descriptor = -1;
  Page* const page = make_page(descriptor);
  if (page == nullptr) {
    const int error = errno;
    if (descriptor >= 0) ::close(descriptor);
    return base::Error{"cannot allocate memory to share with it: " + why(error)};
  }
  write_orders(orders, page->orders);
  const base::Result<int> process = spawn(path, descriptor);
  ::close(descriptor);
  if (!process) {
    ::munmap(page, sizeof(Page));
    return base::Error{process.error()};
  }
  std::unique_ptr<Guardian> guardian(new Guardian(*page, process.value(), orders.bus));
  const std::string problem = wait_until_ready(*page, process.value(), orders.bus);
  if (!problem.empty()) return base::Error{problem};
  return guardian;
}

Guardian::~Guardian() {
  page_.ended.store(1, std::memory_order_release);
  wait_for_end(process_, kEndTime);
  ::munmap(&page_, sizeof(Page));
}

Guardian::Finding Guardian::beat(base::Time now) {
  const std::uint32_t acts = page_.acted.load(std::memory_order_acquire);
  if (!watched_) {
    known_acts_ = acts;
    page_.acknowledged.store(acts, std::memory_order_relaxed);
  }
  if (acts != known_acts_) return Finding::kActed;
  page_.beat_ns.store(base::to_ns(now), std::memory_order_relaxed);
  if (!std::exchange(watched_, true)) page_.watched.store(1, std::memory_order_release);
  const base::Time looked = base::time_from_ns(page_.alive_ns.load(std::memory_order_relaxed));
  return now - looked > kLongestSilence ? Finding::kGone : Finding::kGood;
}

void Guardian::rest() {
  watched_ = false;
  page_.watched.store(0, std::memory_order_release);
}

base::Duration Guardian::silence() const {
  return base::Duration(page_.silent_ns.load(std::memory_order_relaxed));
}

std::string Guardian::describe() const {
  return "process " + std::to_string(process_) + " on the bus '" + bus_ + "', " +
         (page_.urgent != 0 ? "SCHED_FIFO priority 99" : "without real-time priority") + ", " +
         (page_.locked != 0 ? "memory locked" : "memory not locked");
}

}  // namespace armature::guardian
