// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/time.hpp"
#include "robots/wam/emulator/emulated_link.hpp"

namespace armature::wam {

/// The operator of an emulated arm: presses the keys of its pendant, and carries it by hand.
class EmulatedOperator {
 public:
  explicit EmulatedOperator(EmulatedLink& arm) : arm_(arm) {}

  void press_estop() { board().estop(); }
  void press_reset() { board().reset(); }
  void press_idle() { board().shift_idle(); }
  void press_activate() { board().shift_activate(); }
  void carry_home() { arm_.hold_at_home(); }
  void let_go() { arm_.let_go(); }

  /// Carries the arm home if it lies without power, lets it have some, and holds it until it holds
  /// itself.
  /// @thread configuration only
  void bring_to_idle();
  /// Called in each cycle in which activation is asked for: presses a key at a time.
  /// @param idle_first  the board has to go to idle once more before
  /// @rt nonblocking, no allocation
  void help_to_activate(bool idle_first, base::Time now);
  /// Nobody asks any more.
  void rest() { asked_ = false; }

 private:
  SafetyBoard& board() { return arm_.emulator().board(); }

  EmulatedLink& arm_;
  bool asked_ = false;
  base::Time pressed_at_{};
};

}  // namespace armature::wam
