// SPDX-License-Identifier: Apache-2.0
// Cycles through the threads of a running application, as sensor, controller and actuator: each is
// asleep until the one before it writes. Ends when the count is reached, or a wake-up is lost.
#include <atomic>
#include <chrono>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "armature/component/author.hpp"
#include "armature/exec/application.hpp"
#include "tests/stress/watchdog.hpp"

namespace armature::stress {
namespace {

using namespace armature::component;

/// Hands each value on, plus one, until the count is reached.
class Station final : public Component {
 public:
  using Component::Component;
  std::uint64_t last = UINT64_MAX;
  std::atomic<std::uint64_t> seen{0};

 private:
  void hand_on(const std::uint64_t& value) {
    seen.store(value, std::memory_order_relaxed);
    if (value < last) out_.write(value + 1);
  }

  InputPort<std::uint64_t> in_{
      this, "in", "from the station before", "", on_data<&Station::hand_on>, may_stay_open};
  OutputPort<std::uint64_t> out_{this, "out", "for the next station"};
  Operation<void()> begin_{this, "begin", serve<&Station::begin>, "sends the first value",
                           in_own_thread};

  void begin() { out_.write(1); }
};

int run(std::uint64_t cycles) {
  exec::Blueprint blueprint;
  Station* const sensor = &blueprint.add<Station>("Sensor", exec::Activity::triggered());
  Station* const controller = &blueprint.add<Station>("Controller", exec::Activity::triggered());
  Station* const actuator = &blueprint.add<Station>("Actuator", exec::Activity::triggered());
  blueprint.connect("Sensor.out", "Controller.in");
  blueprint.connect("Controller.out", "Actuator.in");
  blueprint.connect("Actuator.out", "Sensor.in");
  for (Station* each : {sensor, controller, actuator}) each->last = 3 * cycles;

  exec::Application application(std::move(blueprint));
  if (const base::Diagnostics diagnostics = application.start(); !diagnostics.ok()) {
    std::printf("%s\n", diagnostics.to_text().c_str());
    return 1;
  }
  const auto begin = std::chrono::steady_clock::now();
  const auto seen = [&] { return sensor->seen.load(); };
  const Watchdog watchdog(seen, [&] {
    std::printf("the stations saw %" PRIu64 ", %" PRIu64 " and %" PRIu64 " of %" PRIu64 "\n",
                sensor->seen.load(), controller->seen.load(), actuator->seen.load(), 3 * cycles);
  });
  if (!application.call("Sensor", "begin", {})) return 1;
  while (seen() < 3 * cycles) application.run_for(std::chrono::milliseconds(10));
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  application.stop();
  std::printf("cycles: %" PRIu64
              " through the 3 threads of an application, none lost (%.1f s, "
              "%.2f us each)\n",
              cycles, seconds, 1e6 * seconds / static_cast<double>(cycles));
  return application.faults() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace armature::stress

int main(int argc, char** argv) {
  if (argc != 2) {
    std::printf("usage: stress_cycle CYCLES\n");
    return 2;
  }
  return armature::stress::run(std::strtoull(argv[1], nullptr, 10));
}
