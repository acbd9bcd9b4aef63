// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "armature/cli/commands.hpp"
#include "armature/cli/internal/command_line.hpp"
#include "armature/edit/save_files.hpp"
#include "armature/edit/unified_diff.hpp"
#include "armature/platform/file.hpp"

namespace armature::cli {
namespace {

/// What an option of the command makes of its words.
using MakeChange = std::function<edit::Change(const std::vector<std::string>& words)>;

struct EditArguments {
  CLI::App* command = nullptr;
  std::map<const CLI::Option*, MakeChange> makers;
  const CLI::Option* settings = nullptr;  ///< of the connection before it
  std::string file;
  std::vector<std::string> files;
  bool overrides = false;
  bool dry_run = false;
};

/// `NAME=REST` as its two parts.
std::pair<std::string, std::string> split(const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos) return {word, {}};
  return {word.substr(0, equals), word.substr(equals + 1)};
}

/// Gives a connection its settings; false if the change is about none.
bool take_settings(edit::Change& change, const std::string& settings) {
  if (auto* connect = std::get_if<edit::Connect>(&change)) {
    connect->settings = settings;
  } else if (auto* connection = std::get_if<edit::SetConnection>(&change)) {
    connection->settings = settings;
  } else {
    return false;
  }
  return true;
}

/// The edits in the order in which they were typed.
base::Result<std::vector<edit::Edit>> edits_of(const EditArguments& arguments) {
  std::vector<edit::Edit> edits;
  std::map<const CLI::Option*, std::ptrdiff_t> read;
  for (const CLI::Option* option : arguments.command->parse_order()) {
    const auto maker = arguments.makers.find(option);
    const bool is_settings = option == arguments.settings;
    if (maker == arguments.makers.end() && !is_settings) continue;
    // CLI11 has an option there once for each of its words.
    const std::ptrdiff_t word = read[option]++;
    const std::ptrdiff_t count = option->get_type_size();
    if (word % count != 0) continue;
    const auto begin = option->results().begin() + word;
    const std::vector<std::string> words(begin, begin + count);
    if (!is_settings) {
      edits.push_back({maker->second(words), arguments.files, arguments.overrides});
      continue;
    }
    if (edits.empty() || !take_settings(edits.back().change, words[0])) {
      return base::Error{"--policy follows the --connect or --connection that it is about"};
    }
  }
  if (edits.empty()) return base::Error{"nothing to edit: armature edit --help lists the edits"};
  return edits;
}

int edit_files(const EditArguments& arguments, const Console& console) {
  const auto edits = edits_of(arguments);
  if (!edits) {
    console.say(rt::LogLevel::kError, edits.error());
    return kWrongUse;
  }
  const document::Limits limits;
  const auto read = [&](const std::string& path) {
    return platform::read_file(path, limits.file_bytes);
  };
  const edit::Outcome outcome = edit::apply_edits(arguments.file, edits.value(), read, limits);
  console.show(outcome.diagnostics);
  if (!outcome.ok()) return kFailed;
  if (arguments.dry_run) {
    for (const edit::FileChange& file : outcome.files) console.print(edit::unified_diff(file));
    return kDone;
  }
  if (const auto saved = edit::save_files(outcome.files); !saved) {
    console.say(rt::LogLevel::kError, saved.error());
    return kFailed;
  }
  for (const edit::FileChange& file : outcome.files) {
    console.say(rt::LogLevel::kInfo, "wrote " + file.file);
  }
  return kDone;
}

/// True for `NAME=REST`, both with something in them.
CLI::Validator with_equals() {
  const auto check = [](const std::string& text) {
    const auto [name, rest] = split(text);
    if (!name.empty() && !rest.empty()) return std::string();
    return "'" + text + "' must have the form NAME=VALUE";
  };
  return CLI::Validator(check, "");
}

/// Adds the options that make edits of their words.
class EditOptions {
 public:
  explicit EditOptions(EditArguments& arguments) : arguments_(arguments) {}

  /// Of a word.
  CLI::Option* one(const char* name, const char* type, const char* help,
                   std::function<edit::Change(const std::string&)> make) {
    return add(name, type, help, 1, [make](const auto& words) { return make(words[0]); });
  }

  /// Of `NAME=REST`.
  void pair(const char* name, const char* type, const char* help,
            std::function<edit::Change(std::string, std::string)> make) {
    one(name, type, help, [make](const std::string& word) {
      auto [first, second] = split(word);
      return make(std::move(first), std::move(second));
    })->check(with_equals());
  }

  /// Of two words.
  void two(const char* name, const char* type, const char* help,
           std::function<edit::Change(std::string, std::string)> make) {
    add(name, type, help, 2, [make](const auto& words) { return make(words[0], words[1]); });
  }

 private:
  CLI::Option* add(const char* name, const char* type, const char* help, int count,
                   MakeChange make) {
    CLI::Option* option = arguments_.command->add_option(name)
                              ->description(help)
                              ->type_name(type)
                              ->type_size(count)
                              ->expected(1, CLI::detail::expected_max_vector_size)
                              ->allow_extra_args(false);
    arguments_.makers[option] = std::move(make);
    return option;
  }

  EditArguments& arguments_;
};

void add_component_options(EditOptions options) {
  using namespace edit;
  options.pair("--set", "NAME=VALUE", "sets a property, a parameter or an activity: Joint1.Gain=2",
               [](std::string path, std::string value) -> Change {
                 return Set{std::move(path), std::move(value)};
               });
  options.one("--unset", "NAME", "takes back what the file says there",
              [](const std::string& path) -> Change { return Unset{path}; });
  options.pair("--add", "NAME=MODEL", "adds a component",
               [](std::string name, std::string model) -> Change {
                 return AddComponent{std::move(name), std::move(model)};
               });
  options.one("--remove", "NAME", "removes a component, its connections and all that refers to it",
              [](const std::string& name) -> Change { return RemoveComponent{name}; });
  options.pair("--rename", "OLD=NEW", "renames a component in all that refers to it",
               [](std::string from, std::string to) -> Change {
                 return Rename{std::move(from), std::move(to)};
               });
  options.pair("--peer", "NAME=PEER", "gives a component a peer",
               [](std::string component, std::string peer) -> Change {
                 return AddPeer{std::move(component), std::move(peer)};
               });
  options.pair("--no-peer", "NAME=PEER", "takes a peer from a component",
               [](std::string component, std::string peer) -> Change {
                 return RemovePeer{std::move(component), std::move(peer)};
               });
}

void add_relation_options(EditOptions options) {
  using namespace edit;
  options.pair("--superior", "NAME=SUPERIOR", "gives a component a peer that commands it",
               [](std::string component, std::string superior) -> Change {
                 return AddSuperior{std::move(component), std::move(superior)};
               });
  options.pair("--no-superior", "NAME=SUPERIOR", "takes a superior from a component",
               [](std::string component, std::string superior) -> Change {
                 return RemoveSuperior{std::move(component), std::move(superior)};
               });
  options.pair("--calls", "NAME=LIST", "says what a Sequence or Request calls: 'Go=[Vision.start]'",
               [](std::string component, std::string calls) -> Change {
                 return SetCalls{std::move(component), std::move(calls)};
               });
}

/// `A,B,C` as its parts.
std::vector<std::string> split_list(const std::string& list) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t end = std::min(list.find(',', at), list.size());
    parts.push_back(list.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

void add_composite_options(EditOptions options) {
  using namespace edit;
  options.two("--split", "NAME PART",
              "gives a part of a range an entry of its own: 'Joint{1..7}' 3, or 3..5",
              [](std::string name, std::string part) -> Change {
                return Split{std::move(name), std::move(part)};
              });
  options.pair("--group", "NAME=A,B,C", "makes components the parts of a composite",
               [](std::string name, const std::string& parts) -> Change {
                 return Group{std::move(name), split_list(parts)};
               });
  options.one("--dissolve", "NAME", "makes the parts of a composite components beside it",
              [](const std::string& name) -> Change { return Dissolve{name}; });
}

void add_mode_options(EditOptions options) {
  using namespace edit;
  options.pair("--mode", "MODE=NAME", "adds a component to a mode; the mode is made if need be",
               [](std::string mode, std::string component) -> Change {
                 return AddToMode{std::move(mode), std::move(component)};
               });
  options.one("--no-mode", "MODE[=NAME]", "removes a mode, or a component from it",
              [](const std::string& word) -> Change {
                auto [mode, component] = split(word);
                if (component.empty()) return RemoveMode{mode};
                return RemoveFromMode{mode, component};
              });
  options.one("--initial-mode", "MODE", "has the application start in a mode",
              [](const std::string& mode) -> Change { return StartInMode{mode}; });
  options.pair("--rename-mode", "OLD=NEW", "renames a mode",
               [](std::string from, std::string to) -> Change {
                 return RenameMode{std::move(from), std::move(to)};
               });
}

/// `Component.name` as its two parts; the name has no dot.
std::pair<std::string, std::string> split_requirement(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  if (dot == std::string::npos) return {path, {}};
  return {path.substr(0, dot), path.substr(dot + 1)};
}

void add_binding_options(EditOptions options) {
  using namespace edit;
  options.pair("--bind", "NAME.REQUIREMENT=PEER.MEMBER", "says which peer serves a requirement",
               [](const std::string& path, std::string target) -> Change {
                 auto [component, name] = split_requirement(path);
                 return Bind{std::move(component), std::move(name), std::move(target)};
               });
  options.one("--unbind", "NAME.REQUIREMENT", "takes that back",
              [](const std::string& path) -> Change {
                auto [component, name] = split_requirement(path);
                return Unbind{std::move(component), std::move(name)};
              });
}

void add_other_options(EditOptions options) {
  using namespace edit;
  options.two("--connect", "FROM TO", "connects two ports, or an event and a command",
              [](std::string from, std::string to) -> Change {
                return Connect{std::move(from), std::move(to)};
              });
  options.two("--disconnect", "FROM TO", "removes a connection",
              [](std::string from, std::string to) -> Change {
                return Disconnect{std::move(from), std::move(to)};
              });
  options.two("--connection", "FROM TO",
              "gives a connection that is there the --policy that follows, or none",
              [](std::string from, std::string to) -> Change {
                return SetConnection{std::move(from), std::move(to)};
              });
  options.one("--no-connection", "NAME", "removes a connection that has this name",
              [](const std::string& name) -> Change {
                return Disconnect{name, {}};
              });
  options.pair("--parameter", "NAME=VALUE", "adds a parameter",
               [](std::string name, std::string value) -> Change {
                 return AddParameter{std::move(name), std::move(value)};
               });
  options.one("--include", "FILE", "includes a file",
              [](const std::string& name) -> Change { return AddInclude{name}; });
  options.one("--no-include", "FILE", "includes a file no longer",
              [](const std::string& name) -> Change { return RemoveInclude{name}; });
  options.one("--library", "NAME", "adds a component library",
              [](const std::string& name) -> Change { return AddLibrary{name}; });
  options.one("--no-library", "NAME", "removes a component library",
              [](const std::string& name) -> Change { return RemoveLibrary{name}; });
}

}  // namespace

void add_edit(const CommandLine& to) {
  CLI::App* command = to.app.add_subcommand(
      "edit", "changes a deployment's text, and proves that nothing else changes");
  const auto arguments = arguments_of(*command, to, edit_files);
  arguments->command = command;
  command->add_option("file", arguments->file, "the deployment, YAML")->required();
  add_component_options(EditOptions(*arguments));
  add_relation_options(EditOptions(*arguments));
  add_composite_options(EditOptions(*arguments));
  add_binding_options(EditOptions(*arguments));
  add_mode_options(EditOptions(*arguments));
  add_other_options(EditOptions(*arguments));
  arguments->settings =
      command->add_option("--policy")
          ->description("keys of the connection before it: 'policy: {fifo: 8}, max_age: 30 ms'")
          ->type_name("KEYS")
          ->type_size(1)
          ->expected(1, CLI::detail::expected_max_vector_size)
          ->allow_extra_args(false);
  command->add_option("--in", arguments->files, "an included file that may be changed, too")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command->add_flag("--override", arguments->overrides,
                    "overrides what included files and ranges say, in FILE itself");
  command->add_flag("--dry-run", arguments->dry_run, "prints the difference, writes nothing");
}

}  // namespace armature::cli
