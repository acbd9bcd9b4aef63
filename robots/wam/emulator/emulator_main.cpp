// SPDX-License-Identifier: Apache-2.0
// The emulated arm as a process of its own.
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "armature/base/seconds.hpp"
#include "armature/can/candump.hpp"
#include "armature/platform/clock.hpp"
#include "armature/platform/memory.hpp"
#include "armature/platform/output_file.hpp"
#include "armature/platform/stop_signal.hpp"
#include "armature/platform/terminal.hpp"
#include "robots/wam/emulator/emulator_input.hpp"
#include "robots/wam/emulator/emulator_report.hpp"
#include "robots/wam/emulator/emulator_screen.hpp"
#include "robots/wam/wam_urdf.hpp"

namespace armature::wam {
namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUse = 2;

constexpr base::Duration kGlance = std::chrono::milliseconds(20);

struct Arguments {
  std::string bus;
  std::size_t joints = kMostMotors;
  std::vector<double> start;
  int firmware = 175;
  std::optional<int> told_firmware;
  int board_firmware = 200;
  std::string state;
  std::string log;
};

std::string as_error(const std::string& text) { return "armature-wam-emulator: error: " + text; }

/// Where lines for machines go, if anywhere.
class Lines {
 public:
  base::Result<void> open(const std::string& path) {
    if (path.empty()) return {};
    auto file = platform::OutputFile::create(path == "-" ? "/dev/stdout" : path);
    if (!file) return base::Error{file.error()};
    file_.emplace(std::move(file).value());
    return {};
  }
  base::Result<void> write(const std::string& line) {
    return file_ ? file_->write(line + "\n") : base::Result<void>{};
  }

 private:
  std::optional<platform::OutputFile> file_;
};

RunningEmulator::Config make_config(const Arguments& arguments) {
  RunningEmulator::Config config;
  config.emulator = Emulator::standard(arguments.joints, arguments.firmware);
  for (Puck::Config& puck : config.emulator.pucks) puck.told_version = arguments.told_firmware;
  config.emulator.board.version = arguments.board_firmware;
  config.arm.urdf_file = arguments.joints == 4 ? "wam4.urdf" : "wam7.urdf";
  config.arm.start = arguments.start;
  config.urdf = arguments.joints == 4 ? kWam4Urdf : kWam7Urdf;
  config.logs_frames = !arguments.log.empty();
  constexpr std::string_view kVirtual = "virtual:";
  if (arguments.bus.starts_with(kVirtual)) {
    config.socket = arguments.bus.substr(kVirtual.size());
  } else if (arguments.bus.find('/') != std::string::npos) {
    config.socket = arguments.bus;
  } else {
    config.interface = arguments.bus;
  }
  return config;
}

/// The emulator and everybody who is told of it, until somebody ends it.
class Session {
 public:
  Session(RunningEmulator& emulator, EmulatorScreen& screen, Lines& states, Lines& log,
          const Arguments& arguments)
      : emulator_(emulator),
        screen_(screen),
        states_(states),
        log_(log),
        joints_(arguments.joints),
        bus_(arguments.bus),
        keys_(platform::is_terminal(platform::kStandardInput)),
        input_(keys_ ? EmulatorInput::Kind::kKeys : EmulatorInput::Kind::kLines) {}

  /// An error of writing ends it, too.
  int run(const platform::StopSignal& stop, base::Time begin) {
    while (!quit_ && !stop.received()) {
      listen(stop);
      if (const auto told = tell(begin); !told) {
        screen_.say(as_error(told.error()));
        return kFailed;
      }
    }
    return kDone;
  }

 private:
  /// What comes from standard input; when that has ended, only signals end the program.
  void listen(const platform::StopSignal& stop) {
    if (!input_open_) {
      stop.wait_until(platform::monotonic_now() + kGlance);
      return;
    }
    if (!platform::wait_readable(platform::kStandardInput, kGlance)) return;
    const auto typed = platform::read_some(platform::kStandardInput, 4096);
    if (!typed) return;
    input_open_ = !typed->empty();
    for (const std::string& command : input_.take(input_open_ ? *typed : "\n")) obey(command);
  }

  void obey(const std::string& command) {
    if (command == "quit") {
      quit_ = true;
      return;
    }
    if (command == "help") {
      screen_.say(emulator_commands() + "  help, quit");
      return;
    }
    const auto parsed = parse_emulator_command(command, joints_);
    if (!parsed) {
      screen_.say(parsed.error());
    } else if (const auto given = emulator_.give(parsed.value()); !given) {
      screen_.say("'" + command + "' is not done: " + given.error());
    }
  }

  base::Result<void> tell(base::Time begin) {
    EmulatorState state;
    while (emulator_.take_state(state)) {
      const double time = base::to_seconds(state.time - begin);
      for (const std::string& change : changes_.take(state, time)) screen_.say(change);
      if (auto written = states_.write(json_line(state, time)); !written) return written;
      screen_.show(state, input_.in_line() && keys_ ? ": " + input_.line() : emulator_keys());
    }
    LoggedFrame logged;
    while (emulator_.take_frame(logged)) {
      const base::Time since_begin{logged.time - begin};
      if (auto written = log_.write(can::to_text({since_begin, log_name(), logged.frame}));
          !written) {
        return written;
      }
    }
    return {};
  }

  /// candump knows no slashes in names of buses.
  std::string log_name() const { return bus_.find('/') == std::string::npos ? bus_ : "can0"; }

  RunningEmulator& emulator_;
  EmulatorScreen& screen_;
  Lines& states_;
  Lines& log_;
  const std::size_t joints_;
  const std::string bus_;
  const bool keys_;
  EmulatorInput input_;
  EmulatorChanges changes_;
  bool input_open_ = true;
  bool quit_ = false;
};

void warn_of_losses(const RunningEmulator& emulator, EmulatorScreen& screen) {
  if (const auto lost = emulator.states_lost(); lost > 0) {
    screen.say("warning: " + std::to_string(lost) + " states were not written in time");
  }
  if (const auto lost = emulator.frames_lost(); lost > 0) {
    screen.say("warning: " + std::to_string(lost) + " frames were not logged in time");
  }
}

int run(const Arguments& arguments) {
  EmulatorScreen screen(platform::is_terminal(platform::kStandardInput) &&
                        platform::is_terminal(platform::kStandardError));
  const auto fail = [&](const std::string& text) {
    screen.say(as_error(text));
    return kFailed;
  };
  Lines states;
  Lines log;
  if (const auto opened = states.open(arguments.state); !opened) return fail(opened.error());
  if (const auto opened = log.open(arguments.log); !opened) return fail(opened.error());
  const platform::StopSignal stop;
  const base::Time begin = platform::monotonic_now();
  auto emulator = RunningEmulator::start(make_config(arguments));
  if (!emulator) return fail(emulator.error());
  if (const auto locked = platform::lock_memory(); !locked)
    screen.say("warning: " + locked.error());
  for (const std::string& refusal : emulator.value()->grant().refusals) {
    screen.say("warning: " + refusal);
  }
  screen.say("an arm of " + std::to_string(arguments.joints) + " joints is there, on " +
             arguments.bus);
  const platform::SingleKeys keys(platform::kStandardInput);
  const int code = Session(*emulator.value(), screen, states, log, arguments).run(stop, begin);
  warn_of_losses(*emulator.value(), screen);
  screen.say("the arm is switched off");
  return code;
}

std::string after_options() {
  return "Keys at a terminal: " + emulator_keys() +
         "\nOtherwise lines on standard input, which are also what follows the colon:\n" +
         emulator_commands() + "  help, quit\n";
}

int run_command_line(int argc, char** argv) {
  CLI::App app{
      "The emulated WAM in real time, with its pucks, safety board and pendant, for hosts in other "
      "processes.\nIt begins in E-stop: release it, then Shift+Idle.",
      "armature-wam-emulator"};
  Arguments arguments;
  app.set_version_flag("--version", "armature " ARMATURE_VERSION);
  app.add_option(
         "--bus", arguments.bus,
         "virtual:PATH makes a virtual bus for hosts with the same; any other name is a CAN "
         "interface, such as vcan0")
      ->type_name("BUS")
      ->required();
  app.add_option("--joints", arguments.joints, "4, or 7 with the wrist")
      ->check(CLI::IsMember({4, 7}))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--start", arguments.start,
                 "where the joints are at first [rad], with commas; else the home position")
      ->delimiter(',')
      ->type_name("RAD,...");
  app.add_option("--firmware", arguments.firmware, "of the pucks")
      ->check(CLI::Range(36, 999))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--told-firmware", arguments.told_firmware,
                 "what the pucks say that they have, if it is something else")
      ->check(CLI::Range(0, 32767))
      ->type_name("N");
  app.add_option("--board-firmware", arguments.board_firmware, "of the safety board")
      ->check(CLI::Range(36, 999))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--state", arguments.state,
                 "writes a JSON object for each state, a hundred a second; -: standard output")
      ->type_name("FILE");
  app.add_option("--log", arguments.log,
                 "writes all frames as candump -l does, with the time since the start; -: standard "
                 "output")
      ->type_name("FILE");
  app.footer(after_options());
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUse;
  }
  return run(arguments);
}

}  // namespace
}  // namespace armature::wam

int main(int argc, char** argv) { return armature::wam::run_command_line(argc, argv); }
