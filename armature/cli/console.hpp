// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/rt/log.hpp"

namespace armature::cli {

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

 private:
  void line(rt::LogLevel level, double seconds, std::string_view component,
            std::string_view text) const;

  bool json_ = false;
  base::Time begin_{};
};

}  // namespace armature::cli
