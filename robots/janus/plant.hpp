// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/can/host_wire.hpp"
#include "armature/platform/thread.hpp"
#include "armature/rt/ring.hpp"
#include "robots/janus/simulation.hpp"

namespace armature::janus {

/// How the simulated head is at a time.
struct PlantState {
  base::Time time{};
  std::array<double, kJoints> position{};  ///< [rad]
  std::array<AicState, kJoints> cards{};
  std::array<bool, kJoints> brake_released{};
};

/// The simulated head with its cards in real time, in a thread of its own, on a bus that hosts in
/// other processes reach.
class Plant {
 public:
  struct Config {
    std::string urdf;          ///< the text
    std::string urdf_name;     ///< for messages
    std::string socket{};      ///< the path of a virtual bus for other processes; or
    std::string interface {};  ///< a CAN interface of this machine
    base::Duration inner_step = std::chrono::microseconds(100);  ///< of the simulated motion
  };
  static constexpr base::Duration kSampleTime = std::chrono::milliseconds(10);

  /// Runs from now on.
  static base::Result<std::unique_ptr<Plant>> start(const Config& config);
  Plant(const Plant&) = delete;
  Plant& operator=(const Plant&) = delete;
  /// Ends in order: the cards without power, the bus left.
  ~Plant();

  /// What the plant's thread asked of the system and got.
  const platform::ThreadGrant& grant() const { return thread_->grant(); }
  /// The next state: every `kSampleTime`, and at once when a card changes; false if there is none.
  bool take_state(PlantState& state);
  /// States that were not taken in time.
  std::uint64_t states_lost() const { return states_lost_.load(std::memory_order_relaxed); }

 private:
  Plant(std::unique_ptr<Simulation> simulation, std::unique_ptr<can::HostWire> wire);
  void run();
  void tell();

  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<can::HostWire> wire_;
  rt::Ring<PlantState> states_;
  std::atomic<std::uint64_t> states_lost_{0};
  std::atomic<bool> stopping_{false};
  PlantState told_;
  std::unique_ptr<platform::Thread> thread_;
};

}  // namespace armature::janus
