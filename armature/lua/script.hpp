// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/exec/application.hpp"

namespace armature::lua {

/// What a script may use.
struct Options {
  std::function<void(std::string_view)> print;          ///< takes a line that the script prints
  base::Duration time_limit = std::chrono::seconds(1);  ///< on the machine's clock, between waits
  std::size_t memory_limit = 64u << 20;                 ///< [bytes]
};

/// A script in Lua 5.4 that commands a running application; docs/scripts.md has its language.
///
/// It runs in the application's controlling thread, between slices of the application's run, never
/// in a thread of components. In simulated time two runs are the same to the bit.
class Script {
 public:
  Script() = default;
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;
  virtual ~Script() = default;

  /// Lets `application`, which runs, go on for `duration` while the script commands it; once. A
  /// mistake of the script is an error in `diagnostics` with its line, and ends the run.
  /// @return kStopRequested if the script said `stop()` or made a mistake, or if `stop` came
  virtual exec::RunEnd run(exec::Application& application, base::Duration duration,
                           const platform::StopSignal* stop, base::Diagnostics& diagnostics) = 0;
};

/// Reads a script; errors of its syntax are added to `diagnostics`. It runs nothing yet.
std::unique_ptr<Script> load_script(const std::string& path, Options options,
                                    base::Diagnostics& diagnostics);

/// Likewise for text in memory. `require` looks beside `path`.
std::unique_ptr<Script> parse_script(std::string_view text, const std::string& path,
                                     Options options, base::Diagnostics& diagnostics);

}  // namespace armature::lua
