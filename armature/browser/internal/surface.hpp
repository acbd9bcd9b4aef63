// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/browser/internal/display.hpp"

namespace armature::browser::internal {

/// Where the task browser writes and hears of the operator: a terminal, a pipe, a test.
class Surface {
 public:
  virtual ~Surface() = default;

  virtual Paper paper() const = 0;
  /// Somebody looks: what is shown may be written anew in place.
  virtual bool live() const = 0;

  /// Whole lines, without the last line's end.
  virtual void say(std::string_view text) = 0;
  virtual void complain(std::string_view text) = 0;
  /// Takes the place of what was shown before, until it is replaced by nothing.
  virtual void show(std::string_view text) = 0;

  /// Ctrl-C came and was not taken yet.
  virtual bool interrupted() const = 0;
  virtual bool take_interrupt() = 0;
  /// Between the two keys are heard one by one.
  virtual void begin_keys() = 0;
  virtual bool take_key() = 0;
  virtual void end_keys() = 0;
};

}  // namespace armature::browser::internal
