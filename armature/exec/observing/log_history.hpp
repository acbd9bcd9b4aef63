// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

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

/// The newest lines of an application's log, for tools that come later or live elsewhere. Lines
/// become text when somebody asks for them: in simulated time the thread that adds them is the one
/// that runs components.
/// @thread the controlling one
class LogHistory {
 public:
  static constexpr std::size_t kCapacity = 200;

  LogHistory() { records_.reserve(kCapacity); }

  /// @rt nonblocking, no allocation
  void add(const rt::LogRecord& record);
  /// Those that are kept and have a greater number, in their order; at most so many.
  std::vector<LogLine> lines_after(std::uint64_t number, std::size_t most) const;

 private:
  std::vector<rt::LogRecord> records_;  ///< a ring once it is full; number n is at (n - 1) % size
  std::uint64_t last_ = 0;
};

}  // namespace armature::exec
