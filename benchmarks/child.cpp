// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/child.hpp"

#include <cstdlib>
#include <stdexcept>

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "armature/platform/file.hpp"

namespace armature::benchmarks {

Child::Child(const std::vector<std::string>& command) : name_(command.front()) {
  std::vector<char*> arguments;
  for (const std::string& each : command) arguments.push_back(const_cast<char*>(each.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int output : {STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&actions, output, "/dev/null", O_WRONLY, 0);
  }
  const int failure =
      posix_spawnp(&process_, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw std::runtime_error("cannot start " + name_);
}

Child::~Child() {
  if (process_ == 0) return;
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
}

void Child::wait() {
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = 0;
  if (status != 0) throw std::runtime_error(name_ + " failed");
}

double Child::resident_bytes() const {
  const std::string file = "/proc/" + std::to_string(process_) + "/smaps_rollup";
  const base::Result<std::string> text = platform::read_file(file);
  const std::string key = "Rss:";
  const std::size_t at = text ? text.value().find(key) : std::string::npos;
  if (at == std::string::npos) throw std::runtime_error(name_ + " ended too early");
  return 1024.0 * std::strtod(text.value().c_str() + at + key.size(), nullptr);
}

}  // namespace armature::benchmarks
