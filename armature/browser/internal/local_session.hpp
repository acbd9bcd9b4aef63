// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "armature/base/time.hpp"
#include "armature/browser/internal/listener.hpp"
#include "armature/browser/internal/session.hpp"
#include "armature/exec/application.hpp"
#include "armature/lua/course.hpp"
#include "armature/lua/interpreter.hpp"

namespace armature::browser::internal {

/// A session at an application of this process. In real time it goes on while somebody types;
/// simulated time passes as lines let it.
/// @thread the controlling one
class LocalSession final : public Session {
 public:
  /// @param application, surface  outlive it
  /// @param duration  of the application's run, in its own time
  LocalSession(exec::Application& application, base::Duration duration,
               const platform::StopSignal* stop, bool simulated, Surface& surface);

  std::string prompt() const override;
  bool keep_up() override { return interpreter_->catch_up(); }
  bool is_ready() override { return true; }
  /// The interpreter tells of it.
  void end_line() override {}
  bool simulated() const override { return simulated_; }
  bool tells_ages() const override { return false; }
  double stamp(base::Duration) const override { return seconds(); }
  std::string interrupted_text() const override;
  bool let_pass(base::Duration duration, const std::function<bool()>& also) override {
    return interpreter_->let_pass(duration, also);
  }
  void wait_for_commands() override { interpreter_->wait_for_commands(); }
  bool cancel_commands() override { return interpreter_->cancel_commands(); }
  void stop() override { course_.stop(); }
  bool has_ended() const override { return course_.has_ended(); }

  exec::RunEnd end() const { return course_.end(); }
  lua::Interpreter& interpreter() { return *interpreter_; }

 private:
  double seconds() const;

  exec::Application& application_;
  bool simulated_;
  base::Time begin_;
  lua::Course course_;
  Listener listener_;
  std::unique_ptr<lua::Interpreter> interpreter_;
};

}  // namespace armature::browser::internal
