// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>

#include "armature/base/near_name.hpp"
#include "armature/base/unit.hpp"
#include "armature/cli/commands.hpp"
#include "armature/platform/printer.hpp"

namespace armature::cli {

std::optional<base::Duration> parse_duration(std::string_view text) {
  const auto quantity = base::parse_quantity(text);
  if (!quantity) return std::nullopt;
  const std::string unit = quantity.value().unit.empty() ? "s" : quantity.value().unit;
  const auto ns = base::convert(quantity.value().value, unit, "ns");
  constexpr double kLongest = 9.0e18;
  if (!ns || !(ns.value() >= 1.0 && ns.value() < kLongest)) return std::nullopt;
  return base::Duration(static_cast<std::int64_t>(ns.value()));
}

namespace {

/// Builds the command line; `chosen` becomes the command to execute.
class CommandLine {
 public:
  explicit CommandLine(Console& console) : console_(console) {
    app_.require_subcommand(1);
    app_.set_version_flag("--version", "armature " ARMATURE_VERSION);
    app_.add_flag_callback(
        "--log-json", [this] { console_.use_json(); }, "messages as one JSON object a line");
    app_.fallthrough();
    add_run();
    add_browse();
    add_check();
    add_graph();
    add_models();
    add_report();
    add_convert();
    add_new();
  }

  int execute(int argc, char** argv) {
    run_.command_line.assign(argv, argv + argc);
    if (const std::string unknown = unknown_command(); !unknown.empty()) {
      console_.say(rt::LogLevel::kError, unknown);
      return kWrongUse;
    }
    try {
      app_.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      if (error.get_exit_code() != 0) return wrong_use(error);
      app_.exit(error);
      return console_.complete_output(kDone);
    }
    return console_.complete_output(chosen_());
  }

 private:
  /// CLI11 would only say that a command is missing.
  std::string unknown_command() const {
    for (std::size_t i = 1; i < run_.command_line.size(); ++i) {
      const std::string& word = run_.command_line[i];
      if (word.starts_with('-')) continue;
      std::vector<std::string> names;
      for (const CLI::App* command : app_.get_subcommands({})) names.push_back(command->get_name());
      if (std::find(names.begin(), names.end(), word) != names.end()) return {};
      return "there is no command '" + word + "' (" + base::suggestion(word, names) + ")";
    }
    return {};
  }

  int wrong_use(const CLI::ParseError& error) {
    const bool is_extra = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
    const std::string unknown = unknown_option();
    if (unknown.empty() || !is_extra) {
      app_.exit(error);
    } else {
      console_.say(rt::LogLevel::kError, unknown);
    }
    return kWrongUse;
  }

  /// CLI11 would not say what was meant.
  std::string unknown_option() const {
    std::vector<std::string> names;
    std::string chosen = "armature";
    const auto add_options = [&names](const CLI::App& of) {
      for (const CLI::Option* option : of.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
      }
    };
    add_options(app_);
    for (const CLI::App* command : app_.get_subcommands()) {
      chosen += " " + command->get_name();
      add_options(*command);
    }
    for (const std::string& word : run_.command_line) {
      const std::string name = word.substr(0, word.find('='));
      const bool known = std::find(names.begin(), names.end(), name) != names.end();
      if (!name.starts_with("--") || name.size() == 2 || known) continue;
      const std::string near = base::near_name(name, names);
      return "'" + chosen + "' has no option '" + name + "' (" +
             (near.empty() ? chosen + " --help lists them" : "did you mean '" + near + "'?") + ")";
    }
    return {};
  }

  /// What is not in `names` is refused with the nearest, or all of them.
  static CLI::Validator one_of(std::vector<std::string> names) {
    const auto check = [names = std::move(names)](const std::string& text) {
      if (std::find(names.begin(), names.end(), text) != names.end()) return std::string();
      return "unknown value '" + text + "' (" + base::suggestion(text, names) + ")";
    };
    return CLI::Validator(check, "");
  }

  /// A misspelt folder would only be missed when a library is not found.
  static CLI::Validator folder() {
    const auto check = [](const std::string& text) {
      std::error_code ignored;
      if (std::filesystem::is_directory(text, ignored)) return std::string();
      return "there is no folder '" + text + "'";
    };
    return CLI::Validator(check, "");
  }

  void add_load_options(CLI::App& command, LoadArguments& load) {
    command.add_option("file", load.file, "the deployment, YAML or OROCOS XML")->required();
    command
        .add_option("--set", load.overrides,
                    "changes a parameter or property: Joint1.GearRatio=0.02")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    command.add_option("--mode", load.mode, "the mode in which it starts")->type_name("NAME");
    add_folders(command, load.library_folders);
    command.add_option("--times", load.times_file, "measured execution times, for the load");
  }

  void add_folders(CLI::App& command, std::vector<std::string>& folders) {
    command.add_option("-L,--library-path", folders, "where component libraries are looked for")
        ->type_name("FOLDER")
        ->check(folder())
        ->allow_extra_args(false);
  }

  void add_run() {
    CLI::App* command = app_.add_subcommand("run", "runs a deployment until stopped (Ctrl-C)");
    add_load_options(*command, run_.load);
    command->add_flag("--sim", run_.simulated, "in simulated time, as fast as possible");
    command
        ->add_option_function<std::string>(
            "--for",
            [this](const std::string& text) {
              run_.duration = parse_duration(text);
              if (!run_.duration) {
                throw CLI::ValidationError("--for", "'" + text + "' is no time above 0, like 10s");
              }
            },
            "how long, for example 10s or 500ms")
        ->type_name("TIME");
    CLI::Option* const script =
        command->add_option("--script", run_.script, "commands it by a script in Lua");
    script->type_name("FILE");
    command->add_flag("--browse", run_.browse, "commands it line by line: the task browser")
        ->excludes(script);
    command
        ->add_option("--listen", run_.listen,
                     "where other processes reach it: tcp://127.0.0.1:4242, unix:/run/robot.sock")
        ->type_name("ADDRESS")
        ->allow_extra_args(false);
    command->add_option("--realtime", realtime_, "off, prefer (default) or require")
        ->check(one_of({"off", "prefer", "require"}))
        ->type_name("MODE");
    command
        ->add_flag("--guard{report}", guard_,
                   "watches real-time threads for allocation, locks and I/O; --guard=abort ends at "
                   "the first")
        ->check(one_of({"report", "abort"}));
    command->add_option("--write-times", run_.write_times, "writes measured execution times");
    command->add_option("--out", run_.output_folder, "the folder for recordings; made if need be")
        ->type_name("FOLDER");
    command->add_option("--trace", run_.trace, "writes the timeline of all threads, for Perfetto")
        ->type_name("FILE");
    command->add_flag("--statistics", run_.statistics, "prints cycles and latencies at the end");
    command->callback([this] {
      if (realtime_ == "off") run_.realtime = exec::RealtimeMode::kOff;
      if (realtime_ == "require") run_.realtime = exec::RealtimeMode::kRequire;
      if (guard_ == "report") run_.guard = rt::GuardMode::kReport;
      if (guard_ == "abort") run_.guard = rt::GuardMode::kAbort;
      chosen_ = [this] { return run(run_, console_); };
    });
  }

  void add_browse() {
    CLI::App* command = app_.add_subcommand(
        "browse", "commands a running application of another process or host line by line");
    command
        ->add_option(
            "address", browse_.address,
            "where it listens: tcp://127.0.0.1:4242, unix:/run/robot.sock, tls://robot:4243")
        ->required();
    command->add_option("--certificate", browse_.certificate, "of this side, for tls://")
        ->type_name("FILE");
    command->add_option("--key", browse_.key, "the certificate's private key")->type_name("FILE");
    command->add_option("--authority", browse_.authority, "whose certificates are taken")
        ->type_name("FILE");
    command->callback([this] { chosen_ = [this] { return browse(browse_, console_); }; });
  }

  void add_check() {
    CLI::App* command = app_.add_subcommand("check", "finds every mistake without running");
    add_load_options(*command, check_.load);
    command->add_flag("--order", check_.order, "prints which thread runs what, in which order");
    command->add_flag("--load", check_.load_table, "prints the load of each thread");
    command->callback([this] { chosen_ = [this] { return check(check_, console_); }; });
  }

  void add_graph() {
    CLI::App* command = app_.add_subcommand("graph", "draws the wiring");
    add_load_options(*command, graph_.load);
    command->add_option("--format", graph_.format, "svg (default), dot or mermaid")
        ->check(one_of({"svg", "dot", "mermaid"}));
    command->add_option("-o,--output", graph_.output, "file to write; standard output otherwise");
    command
        ->add_option("--only", graph_.only,
                     "these components, as Arming,Joint{1..7}, and their neighbours")
        ->type_name("COMPONENT[,COMPONENT]")
        ->delimiter(',')
        ->allow_extra_args(false);
    command->add_flag("--each-line", graph_.each_line, "every connection by itself, none bundled");
    command->callback([this] { chosen_ = [this] { return graph(graph_, console_); }; });
  }

  void add_models() {
    CLI::App* command = app_.add_subcommand("models", "lists component models, or describes one");
    command->add_option("name", models_.name, "the model to describe");
    command->add_option("-l,--library", models_.libraries, "component library to look into")
        ->allow_extra_args(false);
    add_folders(*command, models_.library_folders);
    command->add_flag("--json", models_.json, "for machines");
    command->callback([this] { chosen_ = [this] { return models(models_, console_); }; });
  }

  void add_report() {
    CLI::App* command = app_.add_subcommand("report", "shows recorded runs as one HTML page");
    command->add_option("folder", report_.folder, "of a run, or of folders of runs")->required();
    command->add_option("--out", report_.page, "the page; report.html in that folder otherwise")
        ->type_name("FILE");
    command->callback([this] { chosen_ = [this] { return report(report_, console_); }; });
  }

  void add_convert() {
    CLI::App* command = app_.add_subcommand("convert", "rewrites YAML as OROCOS XML and back");
    command->add_option("from", from_, "the deployment to read")->required();
    command->add_option("to", to_, "the file to write; .xml is OROCOS XML")->required();
    command->callback([this] { chosen_ = [this] { return convert(from_, to_, console_); }; });
  }

  void add_new() {
    CLI::App* command = app_.add_subcommand("new", "makes something to start from");
    command->require_subcommand(1);
    CLI::App* made = command->add_subcommand("component", "a component library that builds");
    made->add_option("name", name_, "of the component, like GripperDriver")->required();
    made->callback([this] { chosen_ = [this] { return new_component(name_, console_); }; });
  }

  CLI::App app_{"Armature: component-based real-time control of robots", "armature"};
  Console& console_;
  RunArguments run_;
  BrowseArguments browse_;
  CheckArguments check_;
  GraphArguments graph_;
  ModelsArguments models_;
  ReportArguments report_;
  std::string realtime_ = "prefer";
  std::string guard_;
  std::string from_;
  std::string to_;
  std::string name_;
  std::function<int()> chosen_;
};

}  // namespace
}  // namespace armature::cli

int main(int argc, char** argv) {
  armature::platform::survive_lost_outputs();
  armature::cli::Console console;
  return armature::cli::CommandLine(console).execute(argc, argv);
}
