// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/printer.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <utility>

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include "armature/base/time.hpp"

namespace armature::platform {
namespace {

std::atomic<std::uint64_t> lost{0};

void lose(std::string_view text) {
  const auto lines = std::count(text.begin(), text.end(), '\n');
  lost.fetch_add(static_cast<std::uint64_t>(std::max<std::ptrdiff_t>(lines, 1)),
                 std::memory_order_relaxed);
}

/// Waits for room also where another process has made the stream one that does not wait.
bool wait_for_room(int descriptor) {
  pollfd stream{.fd = descriptor, .events = POLLOUT, .revents = 0};
  return ::poll(&stream, 1, -1) > 0 || errno == EINTR;
}

void write_or_lose(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written >= 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
      continue;
    }
    const bool again = errno == EINTR || (errno == EAGAIN && wait_for_room(descriptor));
    if (!again) return lose(text);
  }
}

}  // namespace

/// Texts in a ring of bytes, each behind its stream and size, so that printing allocates nothing.
struct Printer::State {
  static constexpr std::size_t kRoom = 64 * 1024;
  struct Head {
    int descriptor = 0;
    std::size_t size = 0;
  };

  std::mutex mutex;
  std::condition_variable changed;
  std::array<char, kRoom> ring;
  std::size_t first = 0;
  std::size_t used = 0;
  bool writing = false;
  bool ending = false;

  void put(const char* bytes, std::size_t count) {
    const std::size_t end = (first + used) % kRoom;
    const std::size_t straight = std::min(count, kRoom - end);
    std::memcpy(&ring[end], bytes, straight);
    std::memcpy(ring.data(), bytes + straight, count - straight);
    used += count;
  }
  void take(char* bytes, std::size_t count) {
    const std::size_t straight = std::min(count, kRoom - first);
    std::memcpy(bytes, &ring[first], straight);
    std::memcpy(bytes + straight, ring.data(), count - straight);
    first = (first + count) % kRoom;
    used -= count;
  }

  bool push(int descriptor, std::string_view text) {
    const std::lock_guard lock(mutex);
    const Head head{descriptor, text.size()};
    if (sizeof head + text.size() > kRoom - used) return false;
    put(reinterpret_cast<const char*>(&head), sizeof head);
    put(text.data(), text.size());
    changed.notify_all();
    return true;
  }

  /// A part of the oldest text; empty once nothing is left and nothing more comes.
  std::string_view next(Head& head, std::array<char, 4096>& room) {
    std::unique_lock lock(mutex);
    writing = false;
    changed.notify_all();
    changed.wait(lock, [this, &head] { return head.size > 0 || used > 0 || ending; });
    if (head.size == 0 && used == 0) return {};
    if (head.size == 0) take(reinterpret_cast<char*>(&head), sizeof head);
    const std::size_t count = std::min(head.size, room.size());
    take(room.data(), count);
    head.size -= count;
    writing = true;
    return {room.data(), count};
  }

  void serve() {
    Head head;
    std::array<char, 4096> room;
    for (;;) {
      const std::string_view text = next(head, room);
      if (text.empty()) return;
      write_or_lose(head.descriptor, text);
    }
  }

  bool wait_until_written(base::Duration limit) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, limit, [this] { return used == 0 && !writing; });
  }
};

namespace {

std::atomic<Printer::State*> active{nullptr};

}  // namespace

void survive_lost_outputs() {
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGTTOU, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
}

void print(int descriptor, std::string_view text) {
  if (text.empty()) return;
  if (Printer::State* const state = active.load()) {
    if (!state->push(descriptor, text)) lose(text);
  } else {
    write_or_lose(descriptor, text);
  }
}

std::uint64_t lost_lines() { return lost.load(std::memory_order_relaxed); }

Printer::Printer() : state_(std::make_shared<State>()) {
  ThreadRequest request;
  request.name = "printer";
  request.stack_bytes = 64 * 1024;
  request.prefault = false;
  thread_ = std::make_unique<Thread>(request, [state = state_] { state->serve(); });
  active = state_.get();
}

Printer::~Printer() {
  constexpr base::Duration kPatience = std::chrono::seconds(1);
  state_->wait_until_written(kPatience);
  active = nullptr;
  {
    const std::lock_guard lock(state_->mutex);
    state_->ending = true;
  }
  state_->changed.notify_all();
  // It may hang in a terminal that takes nothing; the end of the process ends that, too.
  if (!thread_->join_within(std::chrono::milliseconds(100))) thread_->abandon();
}

bool Printer::flush(base::Duration limit) {
  State* const state = active.load();
  return state == nullptr || state->wait_until_written(limit);
}

}  // namespace armature::platform
