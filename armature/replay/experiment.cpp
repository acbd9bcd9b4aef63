// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/experiment.hpp"

#include <filesystem>
#include <string_view>

#include <nlohmann/json.hpp>

#include "armature/platform/file.hpp"

namespace armature::replay {
namespace {

using Json = nlohmann::ordered_json;

Json libraries_json(const std::vector<UsedLibrary>& libraries) {
  Json all = Json::array();
  for (const UsedLibrary& one : libraries) {
    all.push_back({{"name", one.name}, {"file", one.file}, {"hash", one.hash}});
  }
  return all;
}

/// Throws what nlohmann throws if a member is missing or is something else.
Experiment experiment_in(const Json& json) {
  Experiment experiment;
  json.at("armature").get_to(experiment.version);
  json.at("folder").get_to(experiment.folder);
  json.at("deployment").get_to(experiment.deployment);
  json.at("application").get_to(experiment.application);
  experiment.simulated = json.at("time").get<std::string>() == "simulated";
  json.at("set").get_to(experiment.overrides);
  json.at("mode").get_to(experiment.mode);
  json.at("library_folders").get_to(experiment.library_folders);
  for (const Json& one : json.at("libraries")) {
    experiment.libraries.push_back({one.at("name").get<std::string>(),
                                    one.at("file").get<std::string>(),
                                    one.at("hash").get<std::string>()});
  }
  experiment.texts = json.at("texts").get<std::map<std::string, std::string>>();
  experiment.named = json.at("named").get<std::map<std::string, std::string>>();
  experiment.files = json.at("files").get<std::map<std::string, std::string>>();
  experiment.own = json.value("own", std::map<std::string, Experiment::Contents>());
  json.at("outline").get_to(experiment.outline);
  return experiment;
}

}  // namespace

base::Result<void> write_experiment(const std::string& folder, const Experiment& experiment) {
  const Json json{{"armature", experiment.version},
                  {"folder", experiment.folder},
                  {"deployment", experiment.deployment},
                  {"application", experiment.application},
                  {"time", experiment.simulated ? "simulated" : "real"},
                  {"set", experiment.overrides},
                  {"mode", experiment.mode},
                  {"library_folders", experiment.library_folders},
                  {"libraries", libraries_json(experiment.libraries)},
                  {"texts", experiment.texts},
                  {"named", experiment.named},
                  {"files", experiment.files},
                  {"own", experiment.own},
                  {"outline", experiment.outline}};
  return platform::write_file(folder + '/' + kExperimentFile,
                              json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n');
}

base::Result<Experiment> load_experiment(const std::string& folder) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) {
    return base::Error{"'" + folder + "' is no folder: name the one that armature run --out made"};
  }
  const std::string path = folder + '/' + kExperimentFile;
  if (!std::filesystem::exists(path, ignored)) {
    return base::Error{"'" + folder + "' has no " + kExperimentFile +
                       ", so nobody knows what ran: it is left by armature run --out FOLDER of "
                       "this version and later"};
  }
  const auto text = platform::read_file(path);
  if (!text) return base::Error{text.error()};
  return parse_experiment(text.value(), path);
}

base::Result<Experiment> parse_experiment(std::string_view text, const std::string& path) {
  try {
    return experiment_in(Json::parse(text));
  } catch (const Json::exception& problem) {
    return base::Error{"'" + path + "' is not what armature run leaves: " + problem.what()};
  }
}

}  // namespace armature::replay
