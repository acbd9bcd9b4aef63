// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "armature/base/time.hpp"
#include "armature/can/host_wire.hpp"
#include "armature/can/virtual_bus.hpp"

namespace armature::cia402 {

/// Carries frames between a virtual bus and another program over standard input and output, a line
/// for each as candump writes it: `181#2700`. Other lines are for `take_line`.
class PipeWire final : public can::HostWire {
 public:
  explicit PipeWire(can::VirtualBus& bus);

  void take() override;
  void give() override;
  void wait_until(base::Time deadline) override;

  /// The oldest line that was no frame.
  std::optional<std::string> take_line();
  /// The other program has closed its end.
  bool ended() const { return ended_; }

 private:
  void take_text(const std::string& text);

  can::VirtualStation& station_;
  std::string rest_;
  std::deque<std::string> lines_;
  bool ended_ = false;
};

}  // namespace armature::cia402
