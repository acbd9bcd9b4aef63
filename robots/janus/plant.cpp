// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/plant.hpp"

#include <algorithm>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/base/diagnostic.hpp"
#include "armature/platform/clock.hpp"

namespace armature::janus {
namespace {

/// Two seconds of states.
constexpr std::size_t kMostStates = 200;

base::Result<std::unique_ptr<can::HostWire>> make_wire(Simulation& simulation,
                                                       const Plant::Config& config) {
  base::Diagnostics diagnostics;
  auto wire = config.interface.empty()
                  ? can::make_shared_wire(simulation.bus(), config.socket, diagnostics)
                  : can::make_interface_wire(simulation.bus(), config.interface, diagnostics);
  if (wire == nullptr) return base::Error{base::as_reason(diagnostics)};
  return wire;
}

platform::ThreadRequest thread_request() {
  platform::ThreadRequest request;
  request.name = "janus-plant";
  request.scheduler = platform::Scheduler::kFifo;
  request.priority = 85;  // above its hosts' threads: what it is for them happens by itself
  return request;
}

bool equal_but_for_motion(const PlantState& a, const PlantState& b) {
  return a.cards == b.cards && a.brake_released == b.brake_released;
}

}  // namespace

base::Result<std::unique_ptr<Plant>> Plant::start(const Config& config) {
  Simulation::Config simulated;
  simulated.head.urdf_file = config.urdf_name;
  simulated.head.inner_step = config.inner_step;
  simulated.head.begin = platform::monotonic_now();
  simulated.urdf = config.urdf;
  simulated.bit_rate = config.interface.empty() ? kBitRate : can::kTimelessBitRate;
  simulated.clock = platform::monotonic_now;
  simulated.bus_name = config.interface.empty() ? config.socket : config.interface;
  auto simulation = Simulation::make(simulated);
  if (!simulation) return base::Error{simulation.error()};
  auto wire = make_wire(*simulation.value(), config);
  if (!wire) return base::Error{wire.error()};
  return std::unique_ptr<Plant>(new Plant(std::move(simulation).value(), std::move(wire).value()));
}

Plant::Plant(std::unique_ptr<Simulation> simulation, std::unique_ptr<can::HostWire> wire)
    : simulation_(std::move(simulation)),
      wire_(std::move(wire)),
      states_(kMostStates, rt::WhenFull::kDropNewest, PlantState{}),
      thread_(std::make_unique<platform::Thread>(thread_request(), [this] { run(); })) {}

Plant::~Plant() {
  stopping_ = true;
  thread_->join();
  for (std::size_t joint = 0; joint < kJoints; ++joint) simulation_->card(joint).power_off();
}

void Plant::run() {
  while (!stopping_) {
    wire_->take();
    simulation_->advance_to(platform::monotonic_now());
    wire_->give();
    tell();
    wire_->wait_until(std::min(simulation_->next_event(), told_.time + kSampleTime));
  }
}

void Plant::tell() {
  PlantState now;
  now.time = simulation_->now();
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    now.position[joint] = simulation_->head().position(joint, now.time);
    now.cards[joint] = simulation_->card(joint).state();
    now.brake_released[joint] = simulation_->card(joint).brake_released();
  }
  const bool due = now.time >= told_.time + kSampleTime;
  if (!due && equal_but_for_motion(now, told_)) return;
  told_ = now;
  if (states_.push(now) != rt::PushResult::kTaken) {
    states_lost_.fetch_add(1, std::memory_order_relaxed);
  }
}

bool Plant::take_state(PlantState& state) {
  const PlantState* const oldest = states_.pop();
  if (oldest == nullptr) return false;
  state = *oldest;
  return true;
}

}  // namespace armature::janus
