// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/can/frame.hpp"
#include "armature/can/host_wire.hpp"
#include "armature/platform/thread.hpp"
#include "armature/rt/ring.hpp"
#include "robots/wam/emulator/emulator_command.hpp"

namespace armature::wam {

/// How the emulated arm is at a time.
struct EmulatorState {
  base::Time time{};
  std::size_t motors = 0;
  BoardMode mode = BoardMode::kEstop;
  PendantWord pendant{};
  bool zeroed = false;
  bool carried = false;
  bool diverged = false;                       ///< the simulated arm stands still for good
  std::array<double, kMostMotors> position{};  ///< [rad] of the joints
  std::array<double, kMostMotors> torque{};    ///< [N m] of the motors, as their pucks were told
  std::array<PuckState, kMostMotors> pucks{};
  std::uint64_t frames = 0;  ///< that were on the wire, whole, since the beginning
  std::uint64_t broken_frames = 0;
};

/// A frame that was on the wire.
struct LoggedFrame {
  base::Time time{};
  can::Frame frame;
};

/// The emulated arm in real time, in a thread of its own, on a bus that hosts in other processes
/// reach. Its functions are for one other thread, and none of them waits but the last.
class RunningEmulator {
 public:
  struct Config {
    Emulator::Config emulator;  ///< its clock, begin, bit rate and the name of its bus are set here
    ArmSimulation::Config arm{};
    std::string urdf{};        ///< the text of the arm's description
    std::string socket{};      ///< the path of a virtual bus for other processes; or
    std::string interface {};  ///< a CAN interface of this machine
    bool logs_frames = false;  ///< for `take_frame`
  };
  static constexpr base::Duration kSampleTime = std::chrono::milliseconds(10);

  /// Runs from now on, in E-stop. An error says what is wrong in the configuration or with the bus.
  static base::Result<std::unique_ptr<RunningEmulator>> start(const Config& config);
  RunningEmulator(const RunningEmulator&) = delete;
  RunningEmulator& operator=(const RunningEmulator&) = delete;
  /// Leaves the bus.
  ~RunningEmulator();

  /// What the thread asked of the system and got.
  const platform::ThreadGrant& grant() const { return thread_->grant(); }
  /// Is done within `kSampleTime`. An error if there are too many already, or if it is for virtual
  /// buses and this is an interface.
  base::Result<void> give(const EmulatorCommand& command);
  /// The next state: every `kSampleTime`, and at once when anything but motion, torques and the
  /// number of frames changes; false if there is none.
  bool take_state(EmulatorState& state);
  /// The next frame that was on the wire, whole; false if there is none.
  bool take_frame(LoggedFrame& frame);
  /// States and frames that were not taken in time.
  std::uint64_t states_lost() const { return states_lost_.load(std::memory_order_relaxed); }
  std::uint64_t frames_lost() const { return frames_lost_.load(std::memory_order_relaxed); }

 private:
  RunningEmulator(const ArmNumbers& numbers, std::unique_ptr<ArmMotors> motors,
                  std::unique_ptr<Emulator> emulator, std::unique_ptr<can::HostWire> wire,
                  bool logs_frames);
  void run();
  void obey();
  void tell();
  EmulatorState look() const;

  const ArmNumbers& numbers_;
  std::unique_ptr<ArmMotors> motors_;
  std::unique_ptr<Emulator> emulator_;
  std::unique_ptr<can::HostWire> wire_;
  rt::Ring<EmulatorCommand> commands_;
  rt::Ring<EmulatorState> states_;
  rt::Ring<LoggedFrame> frames_;
  std::atomic<std::uint64_t> states_lost_{0};
  std::atomic<std::uint64_t> frames_lost_{0};
  std::atomic<bool> stopping_{false};
  EmulatorState told_;
  std::unique_ptr<platform::Thread> thread_;
};

}  // namespace armature::wam
