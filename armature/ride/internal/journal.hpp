// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <type_traits>

#include "armature/platform/clock.hpp"
#include "armature/rt/log.hpp"

namespace armature::ride::internal {

/// Tells the node's owner what happens, of each kind at most ten a second: what floods a node must
/// not flood its log. What was left out is told with the next of its kind.
/// @thread any
class Journal {
 public:
  Journal(std::string_view node, std::function<void(const rt::LogRecord&)> sink)
      : node_(node), sink_(std::move(sink)) {}

  /// @param format  a string literal, which is the kind
  template <typename... Arguments>
  void tell(rt::LogLevel level, const char* format, const Arguments&... arguments) {
    if (!sink_) return;
    const std::lock_guard lock(mutex_);
    const base::Time now = platform::monotonic_now();
    Kind& kind = kind_of(format);
    if (now >= kind.window_end) {
      kind.window_end = now + std::chrono::seconds(1);
      kind.told = 0;
    }
    if (kind.told >= kMostPerSecond) {
      ++kind.left_out;
      return;
    }
    ++kind.told;
    if (kind.left_out != 0) {
      const std::array left_out{rt::LogArgument(kind.left_out)};
      sink_({level, now, node_, "{} more like the next one are left out", left_out});
      kind.left_out = 0;
    }
    const std::array<rt::LogArgument, sizeof...(arguments)> given{argument(arguments)...};
    sink_({level, now, node_, format, given});
  }

 private:
  static constexpr int kMostPerSecond = 10;
  struct Kind {
    const char* format = nullptr;
    base::Time window_end{};
    int told = 0;
    std::uint64_t left_out = 0;
  };

  template <typename T>
  static rt::LogArgument argument(const T& value) {
    if constexpr (std::is_same_v<T, std::string>) {
      return std::string_view(value);
    } else {
      return value;
    }
  }

  Kind& kind_of(const char* format) {
    for (Kind& kind : kinds_) {
      if (kind.format == nullptr) kind.format = format;
      if (kind.format == format) return kind;
    }
    return kinds_.back();
  }

  const base::FixedText<47> node_;
  const std::function<void(const rt::LogRecord&)> sink_;
  std::mutex mutex_;
  std::array<Kind, 32> kinds_;
};

}  // namespace armature::ride::internal
