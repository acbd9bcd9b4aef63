// SPDX-License-Identifier: Apache-2.0
// What the guard does about a violation, and how it is spoken to.
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <string>

#include <dlfcn.h>
#include <execinfo.h>
#include <pthread.h>
#include <unistd.h>

#include "armature/guard/internal/places.hpp"
#include "armature/guard/internal/report.hpp"
#include "armature/guard/internal/watch.hpp"
#include "armature/platform/elf/symbols.hpp"
#include "armature/rt/loaded_guard.hpp"

namespace armature::guard {
namespace {

using rt::GuardMode;

// All of it is there before any constructor runs: the loader itself allocates.
constinit Places places;
constinit std::atomic<GuardMode> mode{GuardMode::kReport};
constinit std::atomic<bool> news{false};
constinit std::atomic<bool> printing{false};

std::string message(const std::string& text) { return "armature guard: " + text; }

/// Straight to the system: no buffer, no lock.
void print(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
    if (written <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void print_unprinted() {
  if (printing.exchange(true, std::memory_order_acquire)) return;
  const OwnBusiness quiet;
  const int error = errno;
  news.store(false, std::memory_order_relaxed);
  platform::Symbols symbols;
  for (Place& place : places.all()) {
    if (place.printed || !place.complete.load(std::memory_order_acquire)) continue;
    place.printed = true;
    print(message(describe(place, symbols)));
  }
  errno = error;
  printing.store(false, std::memory_order_release);
}

/// The frames from `caller` outwards.
void take_stack(Sighting& sighting, const void* caller) {
  constexpr int kOwnFrames = 8;
  std::array<void*, Sighting::kFrames + kOwnFrames> all{};
  const auto count =
      static_cast<std::size_t>(::backtrace(all.data(), static_cast<int>(all.size())));
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(count);
  auto begin = std::find(all.begin(), end, caller);
  if (begin == end) begin = all.begin();
  sighting.frame_count =
      std::min<std::size_t>(static_cast<std::size_t>(end - begin), Sighting::kFrames);
  std::copy_n(begin, sighting.frame_count, sighting.frames.begin());
}

void name_thread(Sighting& sighting, const rt::GuardState& state) {
  char name[16] = "";
  if (state.thread == nullptr) ::pthread_getname_np(::pthread_self(), name, sizeof name);
  sighting.thread = std::string_view(state.thread != nullptr ? state.thread : name);
  const char* running = nullptr;
  if (state.running_component != nullptr) running = state.running_component(state.context);
  if (running != nullptr) sighting.component = std::string_view(running);
}

class LoadedGuard final : public rt::Guard {
 public:
  void set_mode(GuardMode wanted) override { mode = wanted; }
  std::uint64_t violations() const override { return places.violations(); }
  std::string report() const override {
    const OwnBusiness quiet;
    platform::Symbols symbols;
    std::string text;
    for (const Place& place : places.all()) {
      if (place.complete.load(std::memory_order_acquire)) text += describe(place, symbols);
    }
    return text + summary(places);
  }
  void reset() override {
    news = false;
    places.clear();
  }
};

void read_mode() {
  const char* const value = std::getenv("ARMATURE_GUARD");
  const std::string_view wanted = value == nullptr ? "report" : value;
  if (wanted == "abort") {
    mode = GuardMode::kAbort;
  } else if (wanted == "count") {
    mode = GuardMode::kCount;
  } else if (wanted != "report") {
    print(message("ARMATURE_GUARD is '" + std::string(wanted) +
                  "', expected report, abort or count; reports\n"));
  }
}

void find_state() {
  if (rt::guard_state == nullptr) return;
  const auto* const state = reinterpret_cast<const std::byte*>(&rt::guard_state());
  state_offset = state - static_cast<const std::byte*>(__builtin_thread_pointer());
}

[[gnu::constructor]] void begin() {
  void* frame = nullptr;
  ::backtrace(&frame, 1);  // loads the unwinder, which allocates
  read_mode();
  find_state();
  ::pthread_atfork(nullptr, nullptr, [] { places.clear(); });
}

[[gnu::destructor]] void end() { print_end(); }

}  // namespace

void print_end() {
  if (mode == GuardMode::kCount || places.violations() == 0) return;
  print_unprinted();
  print(message(summary(places)) + "\n");
}

void note_violation(const char* call, const Detail& detail, const void* caller) {
  if (own_business > 0) return;
  const OwnBusiness quiet;
  const int error = errno;
  Sighting sighting;
  sighting.call = call;
  sighting.detail = detail;
  name_thread(sighting, rt::guard_state());
  take_stack(sighting, caller);
  if (places.add(sighting)) news.store(true, std::memory_order_relaxed);
  if (mode.load(std::memory_order_relaxed) == GuardMode::kAbort) {
    print_unprinted();
    std::abort();
  }
  errno = error;
}

void print_news() {
  if (!news.load(std::memory_order_relaxed)) [[likely]]
    return;
  const bool realtime = rt::guard_state != nullptr && rt::guard_state().realtime_depth > 0;
  if (!realtime && mode.load(std::memory_order_relaxed) == GuardMode::kReport) print_unprinted();
}

void* find_next(const char* name) {
  const OwnBusiness quiet;
  void* const function = ::dlsym(RTLD_NEXT, name);
  if (function == nullptr) {
    for (const std::string_view part : {"armature guard: no library has ", name, "\n"}) print(part);
    std::abort();
  }
  return function;
}

}  // namespace armature::guard

ARMATURE_GUARD_EXPORT armature::rt::Guard* armature_guard();
armature::rt::Guard* armature_guard() {
  static constinit armature::guard::LoadedGuard guard;
  return &guard;
}
