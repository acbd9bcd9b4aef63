// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/time.hpp"
#include "robots/wam/emulator/running_emulator.hpp"

namespace armature::wam {

/// What people see of the emulator on standard error: lines, and at a terminal below them what is
/// true now.
class EmulatorScreen {
 public:
  /// @param terminal  shows the status, too
  explicit EmulatorScreen(bool terminal) : terminal_(terminal) {}
  EmulatorScreen(const EmulatorScreen&) = delete;
  EmulatorScreen& operator=(const EmulatorScreen&) = delete;
  /// The status is gone, lines stay.
  ~EmulatorScreen() { erase(); }

  /// @param text  without the last line's end
  void say(const std::string& text);
  /// Shows the status anew, a few times a second; nothing without a terminal.
  /// @param prompt  what is below it: the keys, or the line that is being typed
  void show(const EmulatorState& state, const std::string& prompt);

 private:
  void erase();

  const bool terminal_;
  bool shown_ = false;
  std::string prompt_;
  base::Time shown_at_{};
  EmulatorState last_;
};

}  // namespace armature::wam
