// SPDX-License-Identifier: Apache-2.0
#include "tests/configurations/in_child.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace armature::configurations {
namespace {

constexpr rlim_t kMostSeconds = 120;  // of the processor's time; the wall's is nobody's promise
constexpr rlim_t kMostMemory = rlim_t{4} << 30;

void bound(int resource, rlim_t most) {
  const rlimit limit{most, most};
  ::setrlimit(resource, &limit);
}

[[noreturn]] void work_and_tell(const std::function<std::string()>& work, int to) {
  bound(RLIMIT_CPU, kMostSeconds);
  if (std::string_view(ARMATURE_SANITIZER).empty()) bound(RLIMIT_AS, kMostMemory);
  bound(RLIMIT_CORE, 0);
  const std::string text = work();
  std::fflush(stdout);
  const bool told = ::write(to, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  ::_exit(told ? 0 : 1);
}

std::string all_of(int from) {
  std::string text;
  std::array<char, 4096> buffer;
  for (ssize_t size = 0; (size = ::read(from, buffer.data(), buffer.size())) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(size));
  }
  return text;
}

std::string problem_of(int status) {
  if (WIFSIGNALED(status)) return "it was killed by signal " + std::to_string(WTERMSIG(status));
  if (WEXITSTATUS(status) != 0) return "it ended with " + std::to_string(WEXITSTATUS(status));
  return "";
}

}  // namespace

ChildEnd run_in_child(const std::function<std::string()>& work) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) return {"", "no pipe"};
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    work_and_tell(work, ends[1]);
  }
  ::close(ends[1]);
  ChildEnd end;
  end.written = all_of(ends[0]);
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  end.problem = problem_of(status);
  return end;
}

}  // namespace armature::configurations
