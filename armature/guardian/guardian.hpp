// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/can/bus.hpp"

namespace armature::guardian {

namespace internal {
struct Page;
}

/// What a drive says that is idle; one that may say this or that has several.
struct IdleAnswer {
  std::size_t device = 0;  ///< 0, 1, ..
  can::Frame frame;
  std::array<std::uint8_t, can::Frame::kMostData> mask{};  ///< the bits of its data that count
};

/// What a guardian may do. It sends these frames and no other.
struct Orders {
  std::string bus;  ///< as `can::make_bus` has it, of another process or the kernel
  std::uint32_t bit_rate = 0;
  base::Duration period{};            ///< of the cycle
  std::vector<can::Frame> safe;       ///< which switch drives off: none may move anything
  std::vector<can::Frame> questions;  ///< which ask drives whether they are idle
  std::vector<IdleAnswer> answers;
  can::Filter answers_filter;  ///< lets them through
};

/// Checks what can be known of `orders` without a bus; empty if nothing is wrong.
std::string problem_of(const Orders& orders);

/// The guardian of this process: another one, which has its own way to the bus and switches the
/// drives off within two periods when this process dies, hangs or is stopped.
///
/// It ends when this object does, and acts if the process ends without that.
class Guardian {
 public:
  /// How the guardian stands.
  enum class Finding {
    kGood,
    kActed,  ///< it has switched the drives off, as it saw no cycle
    kGone,   ///< it has died, or is stopped
  };

  /// Starts it, and waits until it has its bus.
  static base::Result<std::unique_ptr<Guardian>> start(const Orders& orders);
  Guardian(const Guardian&) = delete;
  Guardian& operator=(const Guardian&) = delete;
  ~Guardian();

  /// A cycle is run. The first one begins the watch: from then on one is expected in each period.
  /// @return kActed until `rest`, kGone from then on for as long as it is
  /// @rt nonblocking, no allocation
  Finding beat(base::Time now);
  /// No cycle is expected any more: the drives are off.
  /// @rt nonblocking, no allocation
  void rest();

  /// For how long it had seen no cycle when it acted.
  base::Duration silence() const;
  /// What it is, and what the system grants it.
  std::string describe() const;
  int process() const { return process_; }

 private:
  Guardian(internal::Page& page, int process, std::string bus)
      : page_(page), process_(process), bus_(std::move(bus)) {}

  internal::Page& page_;
  const int process_;
  const std::string bus_;
  std::uint32_t known_acts_ = 0;
  bool watched_ = false;
};

}  // namespace armature::guardian
