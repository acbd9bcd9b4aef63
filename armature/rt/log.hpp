// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "armature/base/fixed_text.hpp"
#include "armature/base/time.hpp"
#include "armature/rt/log_argument.hpp"
#include "armature/rt/ring.hpp"

namespace armature::rt {

/// A log line before it is text: `format` is a string literal with `{}` for each of at most four
/// arguments, whose texts it keeps. Together they have kTextRoom bytes, more than any reason of a
/// component; of what is longer the end is left out, which `...` says.
struct LogRecord {
  static constexpr std::size_t kArguments = 4;
  static constexpr std::size_t kTextRoom = 640;

  LogRecord() = default;
  LogRecord(LogLevel its_level, base::Time its_time, std::string_view its_component,
            const char* its_format, std::span<const LogArgument> arguments = {})
      : level(its_level), time(its_time), component(its_component), format(its_format) {
    take(arguments);
  }

  /// @rt nonblocking, no allocation
  void take(std::span<const LogArgument> arguments);
  void take(std::initializer_list<LogArgument> arguments) {
    take(std::span(arguments.begin(), arguments.size()));
  }
  std::string message() const;

  LogLevel level = LogLevel::kInfo;
  base::Time time;
  base::FixedText<47> component;
  const char* format = "";

 private:
  std::array<LogArgument, kArguments> arguments_;
  std::array<std::uint16_t, kArguments> text_ends_{};  ///< in `texts_`
  base::FixedText<kTextRoom> texts_;
};

/// The log lines of one real-time thread on their way to whoever prints them.
class LogQueue {
 public:
  explicit LogQueue(std::size_t capacity) : ring_(capacity, WhenFull::kDropNewest, LogRecord{}) {}

  /// @rt nonblocking, no allocation; a full queue drops the record and counts it
  /// @thread the queue's own
  void push(const LogRecord& record) {
    if (ring_.push(record) == PushResult::kRefused) {
      dropped_.fetch_add(1, std::memory_order_relaxed);
    }
  }

  /// @thread the printer only
  const LogRecord* pop() { return ring_.pop(); }

  std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  Ring<LogRecord> ring_;
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace armature::rt
