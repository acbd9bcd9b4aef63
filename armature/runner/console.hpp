// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/rt/log.hpp"

namespace armature::runner {

/// Messages for people or, as one JSON object a line, for machines; both on standard error, so that
/// standard output is what the command was asked for.
class Console {
 public:
  void use_json() { json_ = true; }
  /// Log lines show the time since `begin`.
  void set_begin(base::Time begin) { begin_ = begin; }

  void log(const rt::LogRecord& record) const;
  /// What the program itself has to say.
  void say(rt::LogLevel level, std::string_view text) const;
  void show(const base::Diagnostics& diagnostics) const;
  /// What the command was asked for, to standard output.
  void print(std::string_view text) const;
  /// Says so if not all of it could be written; who has closed it wants no more of it.
  /// @return `code`, or kFailed in place of kDone
  int complete_output(int code) const;

 private:
  void line(rt::LogLevel level, double seconds, std::string_view component,
            std::string_view text) const;

  bool json_ = false;
  mutable int output_error_ = 0;  ///< the first one, as errno has it
  base::Time begin_{};
};

}  // namespace armature::runner
