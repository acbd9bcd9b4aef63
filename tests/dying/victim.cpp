// SPDX-License-Identifier: Apache-2.0
// Components that end their process, in every way there is, or keep it busy.
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "armature/component/author.hpp"

using namespace armature::component;

namespace {

volatile bool without_end = true;

[[gnu::noinline]] int overflow(int depth) {
  volatile char room[1024];
  room[0] = static_cast<char>(depth);
  return without_end ? overflow(depth + 1) + room[0] : 0;
}

volatile std::uintptr_t nowhere = 0x10;

[[gnu::noinline]] void write_nowhere() { *reinterpret_cast<volatile int*>(nowhere) = 1; }

/// Dies after so many cycles, or when it is told to.
class Victim final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override {
    if (++cycles_ == after_) die(how_);
  }

  void on_sample() {}

  bool die(std::string how) {
    if (how == "exit") std::exit(0);
    if (how == "segv") write_nowhere();
    if (how == "abort") std::abort();
    if (how == "overflow") overflow(0);
    if (how == "terminate") terminate();
    while (how == "hang" && without_end) {
    }
    return false;
  }
  /// As an exception does that nobody may see.
  static void terminate() noexcept {
    if (without_end) std::vector<int>().at(1) = 0;
  }

  Property<std::string> how_{this, "How", "", "exit, segv, abort, overflow, terminate or hang"};
  Property<int> after_{this, "After", std::numeric_limits<int>::max(), "so many cycles"};
  Operation<bool(std::string)> die_{
      this, "die", serve<&Victim::die>, "ends the process", args("how"), in_own_thread};
  EventHandler<> sample_{this,
                         "Sample",
                         serve<&Victim::on_sample>,
                         "has it live in the thread of whoever samples",
                         optional,
                         leads_to_nothing()};

  int cycles_ = 0;
};

/// Keeps a CPU busy.
class Busy final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(for_ms_.get());
    while (std::chrono::steady_clock::now() < end) {
    }
  }

  Property<int> for_ms_{this, "For", 5, "in each cycle", "ms"};
};

/// Says when it was told to stop.
class Drive final : public Component {
 public:
  using Component::Component;

 private:
  Outcome on_start() override {
    note("started");
    return accepted();
  }
  void on_update() override {}
  void on_stop() override { note("stopped"); }
  void estop() { note("estop"); }
  void note(const char* what) {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    log_info("{} at {}", std::string_view(what), std::chrono::duration<double>(now).count());
  }

  Operation<void()> estop_{this, "estop", serve<&Drive::estop>, "", in_own_thread, in_any_state};
};

/// Holds what would fall if it stopped.
class Weight final : public Component {
 public:
  using Component::Component;

 private:
  Reason held() {
    return in_hand_.said() ? Reason() : Reason("a weight; say Weight.in_hand = true");
  }

  OperatorsWord in_hand_{this, "in_hand", "the operator holds it"};
  Holding holding_{this, serve<&Weight::held>};
};

}  // namespace

ARMATURE_COMPONENT_LIBRARY(victim, registry) {
  registry.add<Victim>("Victim", "ends its process");
  registry.add<Busy>("Busy", "keeps a CPU busy");
  registry.add<Weight>("Weight", "holds what would fall");
  registry.add<Drive>("Drive", "says when it was told to stop");
}
