// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "armature/browser/internal/surface.hpp"
#include "armature/inspect/status.hpp"
#include "armature/lua/interpreter.hpp"

namespace armature::browser::internal {

/// Puts what typed Lua gives on the surface.
class Listener final : public lua::Listener {
 public:
  /// @param surface  outlives it
  explicit Listener(Surface& surface) : surface_(surface) {}

  void say(std::string_view line) override { surface_.say(line); }
  void complain(std::string_view text) override;
  void tell(const inspect::CommandStatus& command) override;
  void show_progress(const std::vector<inspect::CommandStatus>& commands) override;
  void end_progress() override { surface_.show(""); }
  bool interrupted() const override { return surface_.interrupted(); }
  bool take_interrupt() override { return surface_.take_interrupt(); }

 private:
  Surface& surface_;
};

}  // namespace armature::browser::internal
