// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/crew.hpp"

#include <cstdio>
#include <exception>

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "benchmarks/check.hpp"

namespace armature::benchmarks {
namespace {

[[noreturn]] void serve(const std::function<void()>& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  try {
    work();
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "armature_bench: error: in a process of its own: %s\n", failure.what());
  }
  _exit(1);
}

}  // namespace

Crew::Crew(std::size_t size, const std::function<void()>& work) {
  for (std::size_t i = 0; i < size; ++i) {
    const pid_t member = fork();
    check(member >= 0, "fork");
    if (member == 0) serve(work);
    members_.push_back(member);
  }
}

Crew::~Crew() {
  for (const pid_t member : members_) kill(member, SIGKILL);
  for (const pid_t member : members_) waitpid(member, nullptr, 0);
}

}  // namespace armature::benchmarks
