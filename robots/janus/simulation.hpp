// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/can/virtual_bus.hpp"
#include "robots/janus/aic/aic_firmware.hpp"
#include "robots/janus/head.hpp"

namespace armature::janus {

/// The whole robot as its host sees it: a CAN bus with card 1 and card 2, each wired to its joint
/// of the simulated head. A host adds a station of its own to `bus()`.
///
/// Time passes in `advance_to` alone: in simulated time two equal runs are equal to the bit; in
/// real time a thread calls it with the time that it is, often enough for the frames' times.
class Simulation {
 public:
  struct Config {
    Head::Config head;
    std::string urdf{};  ///< the text of the URDF, instead of the head's file
    /// Of the bus; above the cards' own where frames have had their time elsewhere already.
    std::uint32_t bit_rate = kBitRate;
    /// The time that it is, asked when a host sends; none: how far the simulation has come. In real
    /// time the application's clock, which any thread may ask.
    can::VirtualBus::Clock clock{};
    std::string bus_name = "can0";
  };

  /// With both cards powered on when the head begins.
  static base::Result<std::unique_ptr<Simulation>> make(const Config& config);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Everything up to and including `until` happens: frames, the cards' timers, the head's motion.
  /// @rt nonblocking, no allocation
  /// @thread always the same, also for all that is not the host's station
  void advance_to(base::Time until);
  /// Up to the next event of the bus or the cards, at most to `until`; for a host that waits for an
  /// answer in simulated time.
  /// @rt nonblocking, no allocation
  void advance_to_next_event(base::Time until);
  base::Time now() const { return bus_.now(); }
  /// When that will be, as far as is known now.
  /// @rt nonblocking, no allocation
  base::Time next_event();

  can::VirtualBus& bus() { return bus_; }
  AicFirmware& card(std::size_t joint) { return *cards_[joint]; }
  Head& head() { return *head_; }

 private:
  Simulation(std::unique_ptr<Head> head, const Config& config);

  std::unique_ptr<Head> head_;
  can::VirtualBus bus_;
  std::array<std::unique_ptr<AicFirmware>, kJoints> cards_;
};

}  // namespace armature::janus
