// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/can/bus.hpp"
#include "drives/canopen/sdo_client.hpp"
#include "drives/cia402/drive_group.hpp"

namespace armature::cia402 {

/// What a host asks and tells its drives by SDO while they are in their cycle: numbers that no PDO
/// carries, and all of its preparation again for a drive that lost its power. One request is under
/// way at a time on the bus, so that the cycle keeps its time.
/// @thread the host's alone
class BackgroundSdo {
 public:
  static constexpr base::Duration kPatience = std::chrono::milliseconds(100);

  enum class Preparation : std::uint8_t {
    kDone,      ///< as the drive was prepared at the start
    kUnderWay,  ///< it is asked who it is, and told
    kRefused,   ///< it is not who it was, or did not take it: see `refused_at`
  };

  /// @param drives  of the group, in its order
  /// @param pause   between two questions for slow numbers
  BackgroundSdo(const DriveGroup& drives, base::Duration pause);

  /// Uses a frame that has come, of whatever kind.
  /// @rt nonblocking, no allocation, O(drives)
  void take(const can::Frame& frame, base::Time now) noexcept;
  /// Sends the request that is next, at most one.
  /// @rt nonblocking, no allocation, O(drives)
  void step(can::Bus& bus, base::Time now) noexcept;

  /// Compares who the drive is, and prepares and starts it as at the start.
  /// @rt nonblocking, no allocation
  void prepare_again(std::size_t drive) noexcept;
  Preparation preparation(std::size_t drive) const { return errands_[drive].preparation; }
  /// The object at which it ended.
  canopen::Address refused_at(std::size_t drive) const { return errands_[drive].refused_at; }

  /// The slow number as it came last, with its sign; none before, and if the drive has no such.
  /// @param i  as in `DriveConfig::slow`
  std::optional<std::int64_t> number(std::size_t drive, std::size_t i) const {
    return errands_[drive].numbers[i].value;
  }

  /// Has no drive watch the heartbeat of a host that ends; answers are not awaited.
  /// @rt nonblocking, no allocation, O(drives)
  void end_heartbeat(can::Bus& bus, base::Time now) noexcept;

 private:
  struct Number {
    canopen::Address address;
    bool is_refused = false;
    std::optional<std::int64_t> value{};
  };
  struct Errands {
    canopen::SdoClient client;
    std::vector<canopen::SdoStep> steps;
    std::vector<Number> numbers;
    Preparation preparation = Preparation::kDone;
    std::size_t step = 0;  ///< of the preparation
    bool starts = false;   ///< it has to be told to
    canopen::Address refused_at{};
  };
  struct Question {
    std::size_t drive = 0;
    std::size_t number = 0;
  };

  bool begin_preparation(can::Bus& bus, base::Time now) noexcept;
  void begin_question(can::Bus& bus, base::Time now) noexcept;
  void end_step(Errands& errands) noexcept;
  void end_question(Errands& errands) noexcept;
  void send(can::Bus& bus, const can::Frame& frame) noexcept;

  std::vector<Errands> errands_;
  std::vector<Question> questions_;  ///< in the order in which they are asked
  const base::Duration pause_;
  base::Time next_question_{};
  std::size_t question_ = 0;
  std::optional<std::size_t> busy_{};  ///< the drive that has to answer
  bool prepares_ = false;              ///< its answer is one of its preparation
  std::optional<can::Frame> reply_{};  ///< to what came
};

}  // namespace armature::cia402
