// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "armature/platform/clock.hpp"

// The emulated arm and its deployment as their operator starts them, two programs on the interfaces
// of scripts/test-socketcan. Time there is counted in instructions, so this tests 500 Hz and all
// timeouts of the product, whatever else the machine does.

namespace armature {
namespace {

using namespace std::chrono_literals;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

constexpr base::Duration kPatience = 15s;

/// What somebody types into, and reads; killed at the end.
class Program {
 public:
  explicit Program(std::vector<std::string> command) {
    std::array<int, 2> in{};
    std::array<int, 2> out{};
    if (::pipe(in.data()) != 0 || ::pipe(out.data()) != 0) std::abort();
    process_ = ::fork();
    if (process_ == 0) {
      ::dup2(in[0], STDIN_FILENO);
      ::dup2(out[1], STDOUT_FILENO);
      ::dup2(out[1], STDERR_FILENO);
      for (const int file : {in[0], in[1], out[0], out[1]}) ::close(file);
      std::vector<char*> arguments;
      for (std::string& argument : command) arguments.push_back(argument.data());
      arguments.push_back(nullptr);
      ::execv(arguments[0], arguments.data());
      ::_exit(127);
    }
    ::close(in[0]);
    ::close(out[1]);
    in_ = in[1];
    out_ = out[0];
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    ::close(in_);
    ::close(out_);
  }

  void type(std::string line) {
    line += '\n';
    EXPECT_EQ(::write(in_, line.data(), line.size()), static_cast<ssize_t>(line.size()));
  }
  /// Waits until it has said so, after what was waited for before.
  testing::AssertionResult says(const std::string& text, base::Duration patience = kPatience) {
    const base::Time end = platform::monotonic_now() + patience;
    std::size_t found = said_.find(text);
    while (found == std::string::npos) {
      if (!hear_until(end)) {
        return testing::AssertionFailure() << "'" << text << "' is not in:\n" << said_;
      }
      found = said_.find(text);
    }
    said_.erase(0, found + text.size());
    return testing::AssertionSuccess();
  }
  void kill() { ::kill(process_, SIGKILL); }
  /// What else it said until it ended by itself.
  std::string rest() {
    const base::Time end = platform::monotonic_now() + kPatience;
    while (hear_until(end)) continue;
    return std::exchange(said_, {});
  }

 private:
  /// False if there is nothing any more.
  bool hear_until(base::Time end) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - platform::monotonic_now());
    pollfd output{out_, POLLIN, 0};
    if (left <= 0ms || ::poll(&output, 1, static_cast<int>(left.count())) <= 0) return false;
    std::array<char, 4096> heard{};
    const ssize_t size = ::read(out_, heard.data(), heard.size());
    if (size <= 0) return false;
    said_.append(heard.data(), static_cast<std::size_t>(size));
    return true;
  }

  pid_t process_ = -1;
  int in_ = -1;
  int out_ = -1;
  std::string said_;
};

struct Case {
  std::string deployment;
  std::string emulator;
  std::string host;

  std::size_t joints() const { return deployment.back() == '4' ? 4 : 7; }
};

void PrintTo(const Case& tested, std::ostream* out) {
  *out << tested.deployment << ", from " << tested.emulator << " to " << tested.host;
}

constexpr const char* kStates = "/tmp/states";

/// What the emulator wrote, a line for each state.
std::vector<std::string> states() {
  std::ifstream file(kStates);
  std::vector<std::string> lines;
  std::string line;
  while (std::getline(file, line) && !file.eof()) lines.push_back(line);
  return lines;
}

/// Numbers behind `name` in a state.
std::vector<double> numbers(const std::string& state, const std::string& name) {
  const std::size_t found = state.find('"' + name + "\":[");
  if (found == std::string::npos) return {};
  std::vector<double> numbers;
  const char* text = state.c_str() + found + name.size() + 3;
  while (*text == '[' || *text == ',') {
    char* end = nullptr;
    numbers.push_back(std::strtod(text + 1, &end));
    text = end;
  }
  return numbers;
}

/// In what the emulator wrote last.
std::vector<double> last(const std::string& name) {
  const std::vector<std::string> all = states();
  return all.empty() ? std::vector<double>{} : numbers(all.back(), name);
}

class DeployedOnCan : public ::testing::TestWithParam<Case> {
 protected:
  void be_ready_and_armed() {
    arm.type("home");
    arm.type("release");
    arm.type("idle");
    ASSERT_TRUE(host.says("waits for Shift+Activate"));
    arm.type("activate");
    ASSERT_TRUE(host.says("holds the arm where it is"));
    host.type("Arming:arm()");
    ASSERT_TRUE(host.says("Arming.arm: done"));
    host.type("run 1");  // until then torques grow slowly
  }
  /// What the browser shows for an expression.
  void expect_shown(const std::string& expression, const std::string& expected) {
    host.type("print('" + expression + "', " + expression + ", 'so it is')");
    EXPECT_TRUE(host.says(expression + "\t" + expected + "\tso it is"));
  }

  std::vector<double> for_its_joints(std::vector<double> numbers) const {
    numbers.resize(GetParam().joints());
    return numbers;
  }
  void begin_to_move_to(const std::vector<double>& positions, int seconds) {
    std::string text;
    for (const double each : for_its_joints(positions)) {
      text += (text.empty() ? "" : ", ") + std::to_string(each);
    }
    host.type("Generator:moveTo(array(" + text + "), " + std::to_string(seconds) + ")");
  }

  Program arm{{EMULATOR, "--bus", GetParam().emulator, "--joints",
               std::to_string(GetParam().joints()), "--state", kStates}};
  Program host{{ARMATURE, "run", WAM "/deployments/" + GetParam().deployment + ".yaml", "--set",
                "bus=" + GetParam().host, "--set", "at_home=true", "--browse", "--statistics"}};
};

TEST_P(DeployedOnCan, AtFiveHundredCyclesASecondItMovesWithEachAnswerAndNamesAnEstop) {
  ASSERT_NO_FATAL_FAILURE(be_ready_and_armed());
  const std::vector<double> there{0.5, -1.5, 0.3, 2.5, -0.3, 0.2, 0.4};
  begin_to_move_to(there, 2);
  host.type("wait");
  ASSERT_TRUE(host.says("Generator.moveTo: done"));
  EXPECT_THAT(last("position"),
              testing::Pointwise(testing::DoubleNear(0.02), for_its_joints(there)));
  expect_shown("WAM.lost_answers", "0");
  expect_shown("WAM.cycles_without_command", "0");

  begin_to_move_to({-0.5, -1.0, 0.0, 2.0, 0.0, 0.0, 0.0}, 4);
  host.type("run 2");
  host.type("print('half way')");
  ASSERT_TRUE(host.says("half way"));
  EXPECT_THAT(last("torque"), testing::Not(testing::Each(0.0)));
  arm.type("estop");
  EXPECT_TRUE(host.says("WAM: fault: E-stop, positions are lost"));
  EXPECT_TRUE(host.says("what led to the fault of WAM is in blackbox-WAM"));
  EXPECT_THAT(last("torque"), testing::Each(0.0));
  host.type("quit");
  EXPECT_THAT(host.rest(), ContainsRegex("thread Sampler: [0-9]+ cycles run, 0 skipped"));
}

TEST_P(DeployedOnCan, KilledInAMotionItsGuardianIdlesTheArmAndKnowsThatItIs) {
  ASSERT_NO_FATAL_FAILURE(be_ready_and_armed());
  begin_to_move_to({0.5, -1.5, 0.3, 2.5, -0.3, 0.2, 0.4}, 4);
  host.type("run 1");
  host.type("print('under way')");
  ASSERT_TRUE(host.says("under way"));
  EXPECT_THAT(last("torque"), testing::Not(testing::Each(0.0)));
  host.kill();
  EXPECT_TRUE(host.says("has died; switches the drives off on " + GetParam().host));
  EXPECT_TRUE(host.says("armature-guardian: the drives on " + GetParam().host + " are idle"));
  // States are in the file 30 ms late at most; the board waits for longer until nobody asks it.
  platform::sleep_until(platform::monotonic_now() + 50ms);
  const std::size_t known = states().size();
  platform::sleep_until(platform::monotonic_now() + 500ms);
  const std::vector<std::string> all = states();
  ASSERT_GT(known, 0U);
  ASSERT_GE(all.size(), known + 25);
  EXPECT_THAT(all[known - 1], HasSubstr(R"("mode":"active")")) << "its guardian is first";
  for (std::size_t i = known - 1; i < all.size(); ++i) {
    ASSERT_THAT(numbers(all[i], "torque"),
                testing::AllOf(testing::SizeIs(GetParam().joints()), testing::Each(0.0)))
        << all[i];
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kernel, DeployedOnCan,
    ::testing::Values(Case{"npid7", "vcan0", "vcan0"}, Case{"npid7", "can0", "can1"},
                      Case{"controller_wam7", "can0", "can1"}, Case{"npid4", "can0", "can1"}),
    [](const auto& test) { return test.param.deployment + "_on_" + test.param.host; });

}  // namespace
}  // namespace armature
