// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <utility>

#include "armature/base/time.hpp"
#include "armature/ride/wire.hpp"

namespace armature::ride {

/// How a request is sent, and how long its answer is waited for.
struct CallOptions {
  base::Duration deadline = std::chrono::seconds(1);
  Priority priority;
};

/// Whether a command went on its way; kMalformed: a parameter is out of its range.
enum class Sent { kYes, kNotConnected, kQueueFull, kMalformed };

/// What a request brought: the result, or why there is none.
template <typename T>
class [[nodiscard]] Answer {
 public:
  explicit Answer(T value) : value_(std::move(value)) {}
  Answer(Code code, std::string error) : code_(code), error_(std::move(error)) {}

  bool ok() const { return code_ == Code::kNone; }
  explicit operator bool() const { return ok(); }
  /// Valid if ok().
  const T& value() const { return value_; }
  T& value() { return value_; }
  Code code() const { return code_; }
  /// Names the component, the operation and what happened; empty if ok().
  const std::string& error() const { return error_; }

 private:
  T value_{};
  Code code_ = Code::kNone;
  std::string error_;
};

/// The answer to a request that returns nothing.
template <>
class [[nodiscard]] Answer<void> {
 public:
  Answer() = default;
  Answer(Code code, std::string error) : code_(code), error_(std::move(error)) {}

  bool ok() const { return code_ == Code::kNone; }
  explicit operator bool() const { return ok(); }
  Code code() const { return code_; }
  const std::string& error() const { return error_; }

 private:
  Code code_ = Code::kNone;
  std::string error_;
};

}  // namespace armature::ride
