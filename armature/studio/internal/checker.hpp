// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/platform/child_process.hpp"

namespace armature::studio::internal {

/// `armature check --serve` as a process of its own, which loads component libraries: one that
/// crashes takes nobody else with it, and another process answers the next request.
/// @thread one
class Checker {
 public:
  /// Told the result of a request as JSON, or why there is none.
  using Then = std::function<void(base::Result<std::string> result)>;

  /// @param command  the program and its arguments
  explicit Checker(std::vector<std::string> command) : command_(std::move(command)) {}

  /// @param request  a JSON object as docs/check_json.md has it, without `id`
  void ask(std::string request, Then then);
  /// To be waited for, then `take`. -1: no process is there.
  int descriptor() const { return process_ ? process_->output() : -1; }
  /// The process that answers now; 0: none. Another one may have the descriptor of the last.
  int process() const { return process_ ? process_->id() : 0; }
  /// Takes what has come.
  void take();
  /// Ends the process when its last request is answered: the next one loads libraries anew.
  void renew();

 private:
  struct Request {
    std::string line;
    Then then;
  };

  void send_next();
  void take_lines();
  void answer(const std::string& line);
  void fail(const std::string& why);

  const std::vector<std::string> command_;
  std::optional<platform::ChildProcess> process_;
  std::deque<Request> requests_;  ///< the first one is asked
  bool asked_ = false;
  bool renew_ = false;
  std::string came_;
};

}  // namespace armature::studio::internal
