// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/completion.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <system_error>

#include <CLI/CLI.hpp>

namespace armature::cli {
namespace {

using CompletionWords = std::vector<std::string>;

/// The command that the words before the last one choose, and what follows it.
struct Chosen {
  const CLI::App* command;
  CompletionWords rest;
};

Chosen chosen_by(const CLI::App& program, const CompletionWords& words) {
  Chosen chosen{&program, {}};
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    const auto commands = chosen.command->get_subcommands({});
    const auto found = std::ranges::find(commands, words[i], &CLI::App::get_name);
    if (found != commands.end()) {
      chosen.command = *found;
    } else {
      chosen.rest.push_back(words[i]);
    }
  }
  return chosen;
}

CompletionWords commands_of(const CLI::App& command) {
  CompletionWords names;
  for (const CLI::App* each : command.get_subcommands({})) {
    if (!each->get_group().empty()) names.push_back(each->get_name());
  }
  return names;
}

CompletionWords options_of(const CLI::App& command) {
  CompletionWords names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// The first word that is a deployment's file.
std::string deployment_among(const CompletionWords& words) {
  for (const std::string& word : words) {
    const std::string ending = std::filesystem::path(word).extension().string();
    std::error_code none;
    if ((ending == ".yaml" || ending == ".yml" || ending == ".xml") &&
        std::filesystem::is_regular_file(word, none)) {
      return word;
    }
  }
  return {};
}

void append(CompletionWords& to, const CompletionWords& names, std::string_view ending = "") {
  std::ranges::transform(names, std::back_inserter(to),
                         [ending](const std::string& name) { return name + std::string(ending); });
}

/// Components first, and their properties once one is chosen: a robot has thousands.
CompletionWords settings(const DeploymentNames& names, const std::string& begun) {
  CompletionWords all;
  if (begun.find('.') == std::string::npos) {
    append(all, names.components, ".");
    append(all, names.parameters, "=");
  } else {
    append(all, names.properties, "=");
  }
  return all;
}

/// Of an option that takes a name of the deployment.
CompletionWords values_of(const std::string& option, const DeploymentNames& names,
                          const std::string& begun) {
  if (option == "--set" || option == "--unset") return settings(names, begun);
  if (option == "--mode" || option == "--no-mode" || option == "--initial-mode") return names.modes;
  static constexpr std::string_view kComponents[] = {"--only", "--remove", "--dissolve", "--split"};
  if (std::ranges::find(kComponents, option) != std::end(kComponents)) return names.components;
  static constexpr std::string_view kBegins[] = {"--rename", "--peer",     "--no-peer",
                                                 "--calls",  "--superior", "--no-superior"};
  if (std::ranges::find(kBegins, option) == std::end(kBegins)) return {};
  CompletionWords all;
  append(all, names.components, "=");
  return all;
}

}  // namespace

std::vector<std::string> completions(const CLI::App& program, const CompletionWords& words,
                                     const ReadNames& read) {
  if (words.empty()) return commands_of(program);
  const std::string& begun = words.back();
  const Chosen chosen = chosen_by(program, words);
  CompletionWords all;
  if (begun.starts_with('-')) {
    all = options_of(*chosen.command);
  } else if (!chosen.rest.empty() && chosen.rest.back().starts_with('-')) {
    if (const std::string file = deployment_among(words); !file.empty()) {
      all = values_of(chosen.rest.back(), read(file), begun);
    }
  } else {
    all = commands_of(*chosen.command);
  }
  std::erase_if(all, [&begun](const std::string& each) { return !each.starts_with(begun); });
  std::ranges::sort(all);
  return all;
}

}  // namespace armature::cli
