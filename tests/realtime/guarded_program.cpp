// SPDX-License-Identifier: Apache-2.0
// A program as users have it: it does not link the guard, and starts itself again behind it.
// usage: guarded_program report|abort|count good|bad|exit|fork
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include "armature/component/component.hpp"
#include "armature/exec/application.hpp"
#include "armature/platform/process.hpp"
#include "armature/rt/loaded_guard.hpp"

namespace {

using namespace armature;
using std::chrono::milliseconds;

/// Forgets that its memory should have been reserved before start.
class Recorder final : public component::Component {
 public:
  using Component::Component;
  bool careless = false;

 private:
  void on_update() override {
    if (careless) remember();
    last_ = static_cast<int>(cycles_.size());
  }
  [[gnu::noinline]] void remember() {
    if (cycles_.size() == cycles_.capacity()) cycles_.reserve(cycles_.size() + 100);
    cycles_.push_back(1);
  }
  std::vector<int> cycles_;
  int last_ = 0;
};

void run_application(bool careless) {
  exec::Blueprint blueprint;
  const auto activity = exec::Activity::periodic(milliseconds(1));
  blueprint.add<Recorder>("recorder", activity).careless = careless;
  exec::Application application(std::move(blueprint));
  if (!application.start().ok()) std::exit(2);
  while (application.thread_statistics().front().cycles_run < 5) {
    application.run_for(milliseconds(1));
  }
  application.run_for(milliseconds(1));
  application.stop();
}

rt::GuardMode mode_named(std::string_view name) {
  if (name == "abort") return rt::GuardMode::kAbort;
  return name == "count" ? rt::GuardMode::kCount : rt::GuardMode::kReport;
}

}  // namespace

int main(int count, char** values) {
  const std::vector<std::string> arguments(values, values + count);
  if (count != 3) return 2;
  const rt::Guard* const guard = rt::loaded_guard();
  if (guard == nullptr) {
    const auto failure =
        platform::start_again(arguments, rt::guard_environment(mode_named(arguments[1])));
    std::fprintf(stderr, "%s\n", failure.message.c_str());
    return 2;
  }
  const std::string& what = arguments[2];
  run_application(what != "good");
  std::printf("%llu violations\n", static_cast<unsigned long long>(guard->violations()));
  std::fflush(stdout);
  if (what == "exit") platform::exit_now(3);
  if (what == "fork") {
    const pid_t child = fork();
    if (child == 0) return guard->violations() == 0 ? 0 : 1;
    int status = 0;
    waitpid(child, &status, 0);
    std::printf("child ended with %d\n", WEXITSTATUS(status));
  }
  return 0;
}
