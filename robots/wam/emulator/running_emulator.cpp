// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/running_emulator.hpp"

#include <algorithm>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/base/diagnostic.hpp"
#include "armature/platform/clock.hpp"

namespace armature::wam {
namespace {

/// The arm is never simulated later, or the next frame would have to wait until it was.
constexpr base::Duration kMostBehind = std::chrono::milliseconds(1);
constexpr std::size_t kMostCommands = 64;
/// Two seconds of states, and of a busy bus.
constexpr std::size_t kMostStates = 200;
constexpr std::size_t kMostFrames = 20'000;

base::Result<std::unique_ptr<can::HostWire>> make_wire(can::VirtualBus& bus,
                                                       const RunningEmulator::Config& config) {
  base::Diagnostics diagnostics;
  auto wire = config.interface.empty()
                  ? can::make_shared_wire(bus, config.socket, diagnostics)
                  : can::make_interface_wire(bus, config.interface, diagnostics);
  if (wire == nullptr) return base::Error{base::as_reason(diagnostics)};
  return wire;
}

Emulator::Config in_real_time(const RunningEmulator::Config& config, base::Time begin) {
  Emulator::Config emulator = config.emulator;
  emulator.begin = begin;
  emulator.clock = platform::monotonic_now;
  emulator.bit_rate = config.interface.empty() ? kBitRate : can::kTimelessBitRate;
  emulator.bus_name = config.interface.empty() ? config.socket : config.interface;
  return emulator;
}

platform::ThreadRequest thread_request() {
  platform::ThreadRequest request;
  request.name = "wam-emulator";
  request.scheduler = platform::Scheduler::kFifo;
  request.priority = 85;  // above its hosts' threads: what it is for them happens by itself
  return request;
}

/// But for what changes all the time.
bool equal_in_rest(const EmulatorState& a, const EmulatorState& b) {
  return a.mode == b.mode && a.pendant == b.pendant && a.zeroed == b.zeroed &&
         a.carried == b.carried && a.diverged == b.diverged && a.pucks == b.pucks;
}

}  // namespace

base::Result<std::unique_ptr<RunningEmulator>> RunningEmulator::start(const Config& config) {
  const ArmNumbers& numbers = config.emulator.pucks.size() == 4 ? wam4() : wam7();
  auto arm = ArmSimulation::parse(numbers, config.urdf, config.arm);
  if (!arm) return base::Error{arm.error()};
  const base::Time begin = platform::monotonic_now();
  auto motors = std::make_unique<ArmMotors>(std::move(arm).value(), begin);
  auto emulator = Emulator::make(in_real_time(config, begin), *motors);
  if (!emulator) return base::Error{emulator.error()};
  auto wire = make_wire(emulator.value()->bus(), config);
  if (!wire) return base::Error{wire.error()};
  return std::unique_ptr<RunningEmulator>(
      new RunningEmulator(numbers, std::move(motors), std::move(emulator).value(),
                          std::move(wire).value(), config.logs_frames));
}

RunningEmulator::RunningEmulator(const ArmNumbers& numbers, std::unique_ptr<ArmMotors> motors,
                                 std::unique_ptr<Emulator> emulator,
                                 std::unique_ptr<can::HostWire> wire, bool logs_frames)
    : numbers_(numbers),
      motors_(std::move(motors)),
      emulator_(std::move(emulator)),
      wire_(std::move(wire)),
      commands_(kMostCommands, rt::WhenFull::kDropNewest, EmulatorCommand{}),
      states_(kMostStates, rt::WhenFull::kDropNewest, EmulatorState{}),
      frames_(logs_frames ? kMostFrames : 1, rt::WhenFull::kDropNewest, LoggedFrame{}) {
  if (logs_frames) {
    emulator_->bus().set_tap([this](const can::WireEvent& event) {
      if (event.outcome != can::Outcome::kGood) return;
      if (frames_.push({event.end, event.frame}) == rt::PushResult::kTaken) return;
      frames_lost_.fetch_add(1, std::memory_order_relaxed);
    });
  }
  thread_ = std::make_unique<platform::Thread>(thread_request(), [this] { run(); });
}

RunningEmulator::~RunningEmulator() {
  stopping_ = true;
  thread_->join();
}

void RunningEmulator::run() {
  while (!stopping_) {
    wire_->take();
    emulator_->advance_to(platform::monotonic_now());
    obey();
    wire_->give();
    tell();
    wire_->wait_until(std::min(emulator_->next_event(), emulator_->now() + kMostBehind));
  }
}

void RunningEmulator::obey() {
  const EmulatedArm arm{*emulator_, *motors_, numbers_};
  while (const EmulatorCommand* const command = commands_.pop()) command->apply(arm);
}

void RunningEmulator::tell() {
  const base::Time now = emulator_->now();
  const EmulatorState state = look();
  if (now < told_.time + kSampleTime && equal_in_rest(state, told_)) return;
  told_ = state;
  if (states_.push(state) != rt::PushResult::kTaken) {
    states_lost_.fetch_add(1, std::memory_order_relaxed);
  }
}

EmulatorState RunningEmulator::look() const {
  const SafetyBoard& board = emulator_->board();
  const can::WireCounters wire = emulator_->bus().counters();
  EmulatorState state{.time = emulator_->now(),
                      .motors = emulator_->motors(),
                      .mode = board.mode(),
                      .pendant = board.pendant(),
                      .zeroed = board.zeroed(),
                      .carried = motors_->carried(),
                      .diverged = motors_->arm().status() != sim::PlantStatus::kGood,
                      .frames = wire.good,
                      .broken_frames = wire.corrupted + wire.lost + wire.aborted};
  for (std::size_t i = 0; i < state.motors; ++i) {
    const Puck& puck = emulator_->puck(i);
    state.position[i] = motors_->arm().joint_position(i);
    state.pucks[i] = puck.state();
    if (puck.state() != PuckState::kReady || puck.mode() != PuckMode::kTorque) continue;
    state.torque[i] = static_cast<double>(puck.torque()) / puck.properties().get(Property::kIpnm);
  }
  return state;
}

base::Result<void> RunningEmulator::give(const EmulatorCommand& command) {
  const can::VirtualBus& bus = emulator_->bus();
  if (command.needs_bit_rate && bus.bit_rate() == can::kTimelessBitRate) {
    return base::Error{"this fault is for virtual buses; use 'ip link set " + bus.name() +
                       " down' to cut an interface"};
  }
  if (commands_.push(command) == rt::PushResult::kTaken) return {};
  return base::Error{"too many commands at once; give it again"};
}

bool RunningEmulator::take_state(EmulatorState& state) {
  const EmulatorState* const oldest = states_.pop();
  if (oldest == nullptr) return false;
  state = *oldest;
  return true;
}

bool RunningEmulator::take_frame(LoggedFrame& frame) {
  const LoggedFrame* const oldest = frames_.pop();
  if (oldest == nullptr) return false;
  frame = *oldest;
  return true;
}

}  // namespace armature::wam
