// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "armature/base/time.hpp"
#include "armature/exec/application.hpp"

namespace armature::browser {

/// The task browser: an operator commands a running application line by line, at a terminal or
/// through a pipe; docs/browser.md has its language.
///
/// It runs in the application's controlling thread. In real time the application goes on while
/// somebody types; simulated time passes as the operator lets it.
class Browser {
 public:
  Browser() = default;
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;
  virtual ~Browser() = default;

  /// Lets `application`, which runs, go on for `duration` at most while lines of the standard input
  /// command it.
  /// @return kStopRequested if the operator ended it, or the input was at its end
  virtual exec::RunEnd run(exec::Application& application, base::Duration duration,
                           const platform::StopSignal* stop) = 0;

  /// What others write to the terminal, whole lines, goes above the line that is being typed.
  virtual void beside(const std::function<void()>& write) = 0;

  /// Whoever types sees what is said.
  virtual bool at_terminal() const = 0;
  /// The input was at its end: nobody will say anything any more.
  virtual bool at_end() const = 0;

  /// Lines that were mistakes, if no terminal was there to see that.
  virtual std::size_t mistakes() const = 0;
};

/// @param simulated  time passes as the operator lets it
std::unique_ptr<Browser> make_browser(bool simulated);

}  // namespace armature::browser
