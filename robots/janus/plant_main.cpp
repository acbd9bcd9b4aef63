// SPDX-License-Identifier: Apache-2.0
// The simulated head as a process of its own.
#include <cstdio>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "armature/base/seconds.hpp"
#include "armature/platform/clock.hpp"
#include "armature/platform/file.hpp"
#include "armature/platform/memory.hpp"
#include "armature/platform/output_file.hpp"
#include "armature/platform/stop_signal.hpp"
#include "robots/janus/janus_urdf.hpp"
#include "robots/janus/plant.hpp"
#include "robots/janus/plant_report.hpp"

namespace armature::janus {
namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUse = 2;

struct Arguments {
  std::string bus;
  std::string interface;
  std::string state;
  std::string urdf;
};

void say(const std::string& text) {
  std::fprintf(stderr, "%s\n", text.c_str());
  std::fflush(stderr);
}

int fail(const std::string& text) {
  say("armature-janus-plant: error: " + text);
  return kFailed;
}

std::optional<Plant::Config> make_config(const Arguments& arguments) {
  Plant::Config config{.urdf = kJanusUrdf,
                       .urdf_name = "janus.urdf",
                       .socket = arguments.bus,
                       .interface = arguments.interface};
  if (arguments.urdf.empty()) return config;
  auto text = platform::read_file(arguments.urdf);
  if (!text) {
    fail(text.error());
    return std::nullopt;
  }
  config.urdf = std::move(text).value();
  config.urdf_name = arguments.urdf;
  return config;
}

/// Where the machine-readable lines go.
class StateLines {
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

/// Until the stop signal; an error of writing ends it, too.
int report_until_stopped(Plant& plant, StateLines& lines, const platform::StopSignal& stop,
                         base::Time begin) {
  ChangeReport changes;
  bool stopped = false;
  while (!stopped) {
    stopped = stop.wait_until(platform::monotonic_now() + Plant::kSampleTime);
    PlantState state;
    while (plant.take_state(state)) {
      const double time = base::to_seconds(state.time - begin);
      for (const std::string& change : changes.take(state, time)) say(change);
      if (const auto written = lines.write(json_line(state, time)); !written) {
        return fail(written.error());
      }
    }
  }
  return kDone;
}

int run(const Arguments& arguments) {
  const auto config = make_config(arguments);
  if (!config) return kFailed;
  StateLines lines;
  if (const auto opened = lines.open(arguments.state); !opened) return fail(opened.error());
  const platform::StopSignal stop;
  const base::Time begin = platform::monotonic_now();
  auto plant = Plant::start(*config);
  if (!plant) return fail(plant.error());
  if (const auto locked = platform::lock_memory(); !locked) say("warning: " + locked.error());
  for (const std::string& refusal : plant.value()->grant().refusals) say("warning: " + refusal);
  say("the head is there, on " + (config->interface.empty() ? config->socket : config->interface));
  const int code = report_until_stopped(*plant.value(), lines, stop, begin);
  if (const auto lost = plant.value()->states_lost(); lost > 0) {
    say("warning: " + std::to_string(lost) + " states were not written in time");
  }
  say("the head is switched off");
  return code;
}

int run_command_line(int argc, char** argv) {
  CLI::App app{
      "The simulated head of Janus with its cards, in real time, for hosts in other processes",
      "armature-janus-plant"};
  Arguments arguments;
  app.set_version_flag("--version", "armature " ARMATURE_VERSION);
  auto* const where = app.add_option_group("bus");
  where->add_option("--bus", arguments.bus, "makes a virtual bus for hosts with bus=virtual:PATH")
      ->type_name("PATH");
  where->add_option("--can", arguments.interface, "is on a CAN interface, such as vcan0")
      ->type_name("INTERFACE");
  where->require_option(1);
  app.add_option("--state", arguments.state,
                 "writes a JSON object for each state, a hundred a second; -: standard output")
      ->type_name("FILE");
  app.add_option("--urdf", arguments.urdf, "another description of the head")->type_name("FILE");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUse;
  }
  return run(arguments);
}

}  // namespace
}  // namespace armature::janus

int main(int argc, char** argv) { return armature::janus::run_command_line(argc, argv); }
