// SPDX-License-Identifier: Apache-2.0
#include "armature/bundle/internal/child.hpp"

#include <chrono>
#include <thread>
#include <utility>

#include "armature/platform/child_process.hpp"

namespace armature::bundle::internal {

Ran run_program(std::vector<std::string> arguments) {
  // The shell puts both outputs into one, in the order in which they were written.
  std::vector<std::string> words{"/bin/sh", "-c", "exec \"$@\" 2>&1", "sh"};
  words.insert(words.end(), std::make_move_iterator(arguments.begin()),
               std::make_move_iterator(arguments.end()));
  auto child = platform::ChildProcess::start(words, {.piped = true});
  if (!child) return {-1, child.error()};
  Ran ran;
  while (const auto part = child.value().read()) {
    ran.output += *part;
    if (part->empty()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  std::optional<int> code;
  while (!(code = child.value().exit_code())) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ran.code = *code;
  return ran;
}

}  // namespace armature::bundle::internal
