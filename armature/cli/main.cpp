// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/cli/commands.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/platform/printer.hpp"

namespace armature::cli {
namespace {

/// Reads the command line, and executes the command that it chooses.
class Program {
 public:
  Program(Console& console, std::vector<std::string> words)
      : console_(console), words_(std::move(words)) {
    app_.require_subcommand(1);
    app_.set_version_flag("--version", "armature " ARMATURE_VERSION);
    app_.add_flag_callback(
        "--log-json", [this] { console_.use_json(); }, "messages as one JSON object a line");
    app_.fallthrough();
    for (const auto add : kCommands) add({app_, console_, words_, chosen_});
  }

  int execute(int argc, char** argv) {
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
    for (std::size_t i = 1; i < words_.size(); ++i) {
      const std::string& word = words_[i];
      if (word.starts_with('-')) continue;
      std::vector<std::string> names;
      for (const CLI::App* command : app_.get_subcommands({})) names.push_back(command->get_name());
      if (std::find(names.begin(), names.end(), word) != names.end()) return {};
      return "unknown command '" + word + "'" + base::suggestion_in_brackets(word, names);
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
    for (const std::string& word : words_) {
      const std::string name = word.substr(0, word.find('='));
      const bool known = std::find(names.begin(), names.end(), name) != names.end();
      if (!name.starts_with("--") || name.size() == 2 || known) continue;
      const std::string near = base::near_name(name, names);
      return "'" + chosen + "' has no option '" + name + "' (" +
             (near.empty() ? chosen + " --help lists them" : "did you mean '" + near + "'?") + ")";
    }
    return {};
  }

  CLI::App app_{"Armature: component-based real-time control of robots", "armature"};
  Console& console_;
  const std::vector<std::string> words_;
  std::function<int()> chosen_;
};

}  // namespace
}  // namespace armature::cli

int main(int argc, char** argv) {
  armature::platform::survive_lost_outputs();
  armature::cli::Console console;
  return armature::cli::Program(console, {argv, argv + argc}).execute(argc, argv);
}
