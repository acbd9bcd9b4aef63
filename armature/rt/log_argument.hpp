// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace armature::rt {
/// How grave a log line is.
enum class LogLevel { kDebug, kInfo, kWarning, kError };

std::string_view name_of(LogLevel level);

/// One argument of a log line: a number, or a text that lives until a LogRecord has taken it.
class LogArgument {
 public:  /// Which type the argument has.
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

  std::string_view text() const { return text_; }
  /// What it is without its text.
  LogArgument without_text() const;
  /// @param text  of a text, which is kept elsewhere
  std::string to_text(std::string_view text) const;
  bool is_text() const { return kind_ == Kind::kText; }

 private:
  Kind kind_ = Kind::kNone;
  union {
    std::int64_t signed_ = 0;
    std::uint64_t unsigned_;
    double double_;
  };
  std::string_view text_;
};

}  // namespace armature::rt
