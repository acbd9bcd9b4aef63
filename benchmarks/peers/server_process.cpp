// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/peers/server_process.hpp"

#include <array>
#include <stdexcept>

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "benchmarks/check.hpp"
#include "benchmarks/on_cpu.hpp"

namespace armature::benchmarks::peers {
namespace {

std::string read_line(int descriptor) {
  std::string line;
  for (char c = 0; ::read(descriptor, &c, 1) == 1 && c != '\n';) line += c;
  return line;
}

pid_t start(const std::string& name, int output) {
  std::string program = "armature_bench_peers";
  std::string serve = "--serve";
  std::string what = name;
  std::array<char*, 4> arguments{program.data(), serve.data(), what.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  pid_t process = 0;
  const int failure =
      posix_spawn(&process, "/proc/self/exe", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw std::runtime_error("the server of " + name + " cannot be started");
  return process;
}

}  // namespace

ServerProcess::ServerProcess(const std::string& name, int cpu) {
  const OnCpu there(cpu);
  std::array<int, 2> ends{};
  check(::pipe2(ends.data(), O_CLOEXEC) == 0, "pipe2");
  process_ = start(name, ends[1]);
  ::close(ends[1]);
  address_ = read_line(ends[0]);
  ::close(ends[0]);
  if (address_.empty()) throw std::runtime_error("the server of " + name + " did not start");
}

ServerProcess::~ServerProcess() {
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

}  // namespace armature::benchmarks::peers
