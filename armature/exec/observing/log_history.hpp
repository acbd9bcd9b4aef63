// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

#include "armature/base/time.hpp"
#include "armature/rt/log.hpp"

namespace armature::exec {

/// A log line as text.
struct LogLine {
  std::uint64_t number = 0;  ///< the application's, from 1
  base::Time time{};         ///< of the cycle in which it was written
  rt::LogLevel level = rt::LogLevel::kInfo;
  std::string component;  ///< or thread, or `application`
  std::string text;

  bool operator==(const LogLine&) const = default;
};

/// The newest lines of an application's log, for tools that come later or live elsewhere.
/// @thread the controlling one
class LogHistory {
 public:
  static constexpr std::size_t kCapacity = 500;

  void add(const rt::LogRecord& record);
  /// In their order; the oldest are dropped.
  const std::deque<LogLine>& lines() const { return lines_; }

 private:
  std::deque<LogLine> lines_;
  std::uint64_t last_ = 0;
};

}  // namespace armature::exec
