// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

#include "armature/base/fixed_text.hpp"
#include "armature/base/time.hpp"
#include "armature/rt/ring.hpp"

namespace armature::rt {

enum class LogLevel { kDebug, kInfo, kWarning, kError };

std::string_view name_of(LogLevel level);

/// One argument of a log line, kept as it is: it becomes text where somebody may wait.
class LogArgument {
 public:
  enum class Kind { kNone, kSigned, kUnsigned, kDouble, kBool, kText };

  LogArgument() = default;
  template <std::signed_integral T>
  LogArgument(T value) : kind_(Kind::kSigned), signed_(value) {}  // NOLINT
  template <std::unsigned_integral T>
  LogArgument(T value) : kind_(Kind::kUnsigned), unsigned_(value) {}         // NOLINT
  LogArgument(double value) : kind_(Kind::kDouble), double_(value) {}        // NOLINT
  LogArgument(bool value) : kind_(Kind::kBool), unsigned_(value) {}          // NOLINT
  LogArgument(std::string_view value) : kind_(Kind::kText), text_(value) {}  // NOLINT
  LogArgument(const char* value) : LogArgument(std::string_view(value)) {}   // NOLINT

  std::string to_text() const;

 private:
  Kind kind_ = Kind::kNone;
  union {
    std::int64_t signed_ = 0;
    std::uint64_t unsigned_;
    double double_;
  };
  base::FixedText<95> text_;
};

/// A log line before it is text: `format` is a string literal with `{}` for each argument.
struct LogRecord {
  LogLevel level = LogLevel::kInfo;
  base::Time time;
  base::FixedText<47> component;
  const char* format = "";
  std::array<LogArgument, 4> arguments;

  std::string message() const;
};

/// The log lines of one real-time thread on their way to whoever prints them.
class LogQueue {
 public:
  explicit LogQueue(std::size_t capacity) : ring_(capacity, WhenFull::kRefuse, LogRecord{}) {}

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
