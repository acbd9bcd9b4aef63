// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/exec/engine.hpp"
#include "armature/exec/observing/log_history.hpp"

namespace armature::exec::internal {

/// Carries log lines from the engines' queues to a sink, which may be empty, and keeps the newest.
/// A sink that throws gets no more of them.
class LogPump {
 public:
  using Sink = std::function<void(const rt::LogRecord&)>;

  explicit LogPump(Sink sink) : sink_(std::move(sink)) {}

  void set_engines(std::vector<Engine*> engines);

  void drain();
  void drain(Engine& engine);
  /// One warning for each thread that lost lines since the last time.
  void tell_losses(base::Time now);
  /// The same, if it was not done for a second.
  void tell_losses_now_and_then(base::Time now);
  /// The controlling thread's own line.
  void say(std::string_view text, base::Time now);
  /// What the sink threw; empty if it did not.
  const std::string& failure() const { return failure_; }
  const LogHistory& history() const { return history_; }

 private:
  struct Source {
    Engine* engine;
    std::uint64_t told_losses = 0;
  };

  void tell(const rt::LogRecord& record) noexcept;

  Sink sink_;
  LogHistory history_;
  std::string failure_;
  std::vector<Source> sources_;
  base::Time told_at_{};
};

}  // namespace armature::exec::internal
