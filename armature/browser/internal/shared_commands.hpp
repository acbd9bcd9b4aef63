// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "armature/browser/internal/display.hpp"
#include "armature/browser/internal/language.hpp"
#include "armature/browser/internal/robot.hpp"
#include "armature/browser/internal/surface.hpp"
#include "armature/browser/internal/words.hpp"
#include "armature/component/component.hpp"

namespace armature::browser::internal {

/// The commands that a task browser has for any robot, of this process or of another.
class SharedCommands {
 public:
  /// Lines that were mistakes.
  std::size_t mistakes() const { return mistakes_; }

 protected:
  /// All outlive it; `robot` is not used before the first command.
  SharedCommands(Robot& robot, const Language& language, Surface& surface)
      : robot_(robot), language_(language), surface_(surface) {}
  ~SharedCommands() = default;

  Robot& robot() { return robot_; }
  Surface& surface() { return surface_; }
  Paper paper() const { return surface_.paper(); }
  /// Tells of a mistake and counts it.
  void mistake(std::string_view text);
  void count_mistake() { ++mistakes_; }
  bool takes_nothing(std::string_view command, const Words& arguments);

  void list(const Words& names);
  void help(const Words& subjects);
  void threads(const Words& arguments);
  void faults(const Words& arguments);
  void start(const Words& names);
  void stop_components(const Words& names);
  void reset(const Words& names);
  void recover(const Words& names);
  void clean_up(const Words& names);

 private:
  /// @return whose change was not refused
  Words change(const Words& names, const std::string& change);
  void start_those_that_stopped_again(const Words& started);
  Words all_in(component::State state);

  Robot& robot_;
  const Language& language_;
  Surface& surface_;
  std::size_t mistakes_ = 0;
};

}  // namespace armature::browser::internal
