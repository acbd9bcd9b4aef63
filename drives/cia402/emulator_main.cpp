// SPDX-License-Identifier: Apache-2.0
// Emulated drives as a process of their own.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>

#include "armature/base/as_reason.hpp"
#include "armature/base/diagnostic.hpp"
#include "armature/can/host_wire.hpp"
#include "armature/platform/clock.hpp"
#include "armature/platform/own_priority.hpp"
#include "armature/platform/stop_signal.hpp"
#include "armature/platform/terminal.hpp"
#include "drives/canopen/eds.hpp"
#include "drives/cia402/emulated_bus.hpp"
#include "drives/cia402/emulator_command.hpp"
#include "drives/cia402/pipe_wire.hpp"
#include "drives/cia402/plant_arm.hpp"

namespace armature::cia402 {
namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUse = 2;
/// Axes are never simulated later.
constexpr base::Duration kMostBehind = std::chrono::milliseconds(1);
constexpr base::Duration kLastAnswers = std::chrono::milliseconds(100);
constexpr std::string_view kVirtual = "virtual:";
constexpr std::uint32_t kBitRate = 1'000'000;
/// Above the components of hosts, as drives have processors of their own, and below guardians.
constexpr int kPriority = 90;

struct Arguments {
  std::string bus;
  std::size_t drives = 1;
  std::string urdf;
  unsigned first_node = 1;
  double inertia = 0.1;
  bool no_brake = false;
  bool eds = false;
};

void say(const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); }

base::Result<EmulatedBus::Config> make_config(const Arguments& arguments) {
  EmulatedBus::Config config;
  config.name = arguments.bus;
  config.bit_rate = arguments.bus.starts_with(kVirtual) ? kBitRate : can::kTimelessBitRate;
  config.drives = arguments.drives;
  config.first_node = static_cast<canopen::NodeId>(arguments.first_node);
  config.drive.axis.inertia = arguments.inertia;
  config.drive.brake = !arguments.no_brake;
  config.clock = platform::monotonic_now;
  if (!arguments.urdf.empty()) {
    auto arm = PlantArm{.file = arguments.urdf, .rotor_inertia = arguments.inertia}.make();
    if (!arm) return base::Error{arm.error()};
    config.arm = std::move(arm).value();
    config.drives = config.arm->joints();
  }
  config.begin = platform::monotonic_now();
  return config;
}

/// Lines that the operator types, where standard input carries no frames.
class Lines {
 public:
  std::optional<std::string> next() {
    if (open_ && platform::wait_readable(platform::kStandardInput, {})) {
      const auto text = platform::read_some(platform::kStandardInput, 4096);
      open_ = !text || !text->empty();
      if (text) rest_ += *text;
    }
    const std::size_t end = rest_.find('\n');
    if (end == std::string::npos) return std::nullopt;
    std::string line = rest_.substr(0, end);
    rest_.erase(0, end + 1);
    return line;
  }

 private:
  std::string rest_;
  bool open_ = true;
};

/// The drives and who is told of them, until somebody ends it.
class Session {
 public:
  Session(EmulatedBus& drives, can::HostWire& wire, PipeWire* pipe)
      : drives_(drives), wire_(wire), pipe_(pipe) {}

  void run(const platform::StopSignal& stop) {
    while (!quit_ && !stop.received() && !is_over()) {
      wire_.take();
      const base::Time now = platform::monotonic_now();
      drives_.advance_to(now);
      wire_.give();
      while (const auto line = next_line()) obey(*line, now);
      wire_.wait_until(
          std::min(drives_.bus().next_event().value_or(now + kMostBehind), now + kMostBehind));
    }
  }

 private:
  /// The other program has ended, and had time to read the last answers.
  bool is_over() {
    if (pipe_ == nullptr || !pipe_->ended()) return false;
    if (!end_) end_ = platform::monotonic_now() + kLastAnswers;
    return platform::monotonic_now() > *end_;
  }

  std::optional<std::string> next_line() {
    return pipe_ != nullptr ? pipe_->take_line() : lines_.next();
  }

  void obey(const std::string& line, base::Time now) {
    if (line == "quit") {
      quit_ = true;
    } else if (line == "help") {
      say(emulator_commands() + "  help, quit");
    } else {
      const auto given = give_command(drives_, line, now);
      say(given ? (given.value().empty() ? "done: " + line : given.value()) : given.error());
    }
  }

  EmulatedBus& drives_;
  can::HostWire& wire_;
  PipeWire* pipe_;
  Lines lines_;
  std::optional<base::Time> end_;
  bool quit_ = false;
};

int fail(const std::string& text) {
  say("armature-cia402-emulator: error: " + text);
  return kFailed;
}

/// What the first drive is, for tools that configure it.
int print_eds(EmulatedBus& drives) {
  const canopen::Eds eds =
      canopen::describe(drives.drive(0).device().dictionary(), "Armature", "Emulated drive");
  std::fputs(canopen::to_text(eds).c_str(), stdout);
  return kDone;
}

int run(const Arguments& arguments) {
  const platform::StopSignal stop;
  const auto config = make_config(arguments);
  if (!config) return fail(config.error());
  auto drives = EmulatedBus::make(config.value());
  if (!drives) return fail(drives.error());
  if (arguments.eds) return print_eds(*drives.value());
  can::VirtualBus& bus = drives.value()->bus();
  base::Diagnostics diagnostics;
  std::unique_ptr<can::HostWire> wire;
  PipeWire* pipe = nullptr;
  if (arguments.bus == "-") {
    auto made = std::make_unique<PipeWire>(bus);
    pipe = made.get();
    wire = std::move(made);
  } else if (arguments.bus.starts_with(kVirtual)) {
    wire = can::make_shared_wire(bus, arguments.bus.substr(kVirtual.size()), diagnostics);
  } else {
    wire = can::make_interface_wire(bus, arguments.bus, diagnostics);
  }
  if (wire == nullptr) return fail(base::as_reason(diagnostics));
  if (!platform::set_own_priority(kPriority)) {
    say("the system refuses SCHED_FIFO: on a busy machine the drives answer late, as real ones do "
        "not");
  }
  say("drives are there: " + std::to_string(drives.value()->size()) + ", from node " +
      std::to_string(arguments.first_node) + " on");
  Session(*drives.value(), *wire, pipe).run(stop);
  return kDone;
}

int run_command_line(int argc, char** argv) {
  CLI::App app{"Emulated drives by CiA 402 on CANopen, in real time, for hosts in other processes.",
               "armature-cia402-emulator"};
  Arguments arguments;
  app.set_version_flag("--version", "armature " ARMATURE_VERSION);
  app.add_option("--bus", arguments.bus,
                 "virtual:PATH makes a virtual bus for hosts with the same; - carries frames over "
                 "standard input and output, a line each as candump writes it; any other name is a "
                 "CAN interface, such as vcan0")
      ->type_name("BUS");
  CLI::Option* const drives = app.add_option("--drives", arguments.drives, "how many")
                                  ->check(CLI::Range(1, 127))
                                  ->type_name("N")
                                  ->capture_default_str();
  app.add_option(
         "--urdf", arguments.urdf,
         "the description of an arm that they move, a drive for each joint; none: an axis each")
      ->check(CLI::ExistingFile)
      ->type_name("FILE")
      ->excludes(drives);
  app.add_option("--first-node", arguments.first_node, "of the first; the others follow")
      ->check(CLI::Range(1, 127))
      ->type_name("NODE")
      ->capture_default_str();
  app.add_option("--inertia", arguments.inertia,
                 "of each axis; of an arm, of each motor at its joint [kg m2]")
      ->check(CLI::Range(1e-4, 1e3))
      ->type_name("J")
      ->capture_default_str();
  app.add_flag("--no-brake", arguments.no_brake, "axes run out when their drive is off");
  app.add_flag("--eds", arguments.eds, "prints the EDS of the first drive and ends");
  app.footer("Commands, a line each on standard input:\n" + emulator_commands() + "  help, quit\n");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUse;
  }
  if (arguments.bus.empty() && !arguments.eds) {
    say("armature-cia402-emulator: error: --bus is missing (such as --bus "
        "virtual:/tmp/drives.bus)");
    return kWrongUse;
  }
  return run(arguments);
}

}  // namespace
}  // namespace armature::cia402

int main(int argc, char** argv) { return armature::cia402::run_command_line(argc, argv); }
