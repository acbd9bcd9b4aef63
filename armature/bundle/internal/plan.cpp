// SPDX-License-Identifier: Apache-2.0
#include "armature/bundle/internal/plan.hpp"

#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include "armature/bundle/internal/debian.hpp"
#include "armature/bundle/internal/deployment_files.hpp"
#include "armature/bundle/internal/deployment_root.hpp"
#include "armature/bundle/internal/installation.hpp"
#include "armature/deploy/loader.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/platform/elf/linked_file.hpp"

namespace armature::bundle::internal {
namespace {

namespace fs = std::filesystem;
using document::path_in_quotes;

/// What the commands before a stop may take, on top of the time for which something is held.
constexpr base::Duration kTimeOfCommands = std::chrono::minutes(1);
constexpr base::Duration kUsualHold = std::chrono::minutes(1);

class Planner {
 public:
  Planner(const BundleRequest& request, const document::Document& document,
          base::Diagnostics& diagnostics)
      : request_(request), document_(document), diagnostics_(diagnostics) {}

  std::optional<Plan> plan() {
    choose_name();
    choose_architecture();
    if (!diagnostics_.ok()) return std::nullopt;
    choose_target();
    plan_deployment();
    plan_programs();
    if (!diagnostics_.ok()) return std::nullopt;
    tell_of_run();
    return std::move(plan_);
  }

 private:
  void choose_name() {
    const std::string application = document_.application.empty()
                                        ? fs::path(request_.file).stem().string()
                                        : document_.application;
    plan_.facts.name = name_of_bundle(application);
    plan_.facts.version = request_.version;
    if (!plan_.facts.name.empty()) return;
    diagnostics_.error({request_.file, 0, 0},
                       "application '" + application +
                           "' cannot name a bundle, expected letters, digits, '.', '_' and '-'",
                       "give the deployment another application: NAME");
  }

  void choose_architecture() {
    const auto own = platform::read_linked_file(request_.program);
    here_ = own ? architecture_of(own.value()) : nullptr;
    plan_.architecture =
        request_.architecture.empty() ? here_ : find_architecture(request_.architecture);
    plan_.foreign = plan_.architecture != here_;
    if (plan_.architecture == nullptr) {
      return diagnostics_.error(
          {}, "bundles are made for amd64, arm64 and armhf, found another machine");
    }
    plan_.facts.architecture = plan_.architecture->name;
    if (!plan_.foreign || !request_.installation.empty()) return;
    diagnostics_.error({},
                       "a bundle for " + request_.architecture +
                           " needs an Armature that was built for it; this one was built for " +
                           (here_ == nullptr ? "another machine" : std::string(here_->name)),
                       "install Armature on a machine of that kind (cmake --install BUILD --prefix "
                       "FOLDER), copy FOLDER here and name it by --installation");
  }

  void plan_deployment() {
    const DeploymentFiles files =
        find_files({request_.file, request_.overrides, request_.script}, diagnostics_);
    root_ = deployment_root(files, diagnostics_);
    if (root_.empty()) return;
    for (const auto& [file, where] : files.files) plan_.copies[place_of(file)] = {file, where};
    for (const std::string& file : files.saved) plan_.facts.saved.push_back(place_of(file));
    for (const std::string& key : files.keys) plan_key(key);
    libraries_in_deployment_ = {files.libraries.begin(), files.libraries.end()};
  }

  void plan_key(const std::string& key) {
    const std::string place = place_of(key);
    plan_.keys[place] = key;
    plan_.facts.keys.push_back(place);
    diagnostics_.note({}, "the private key " + path_in_quotes(place) +
                              " is not in the bundle: put it there by hand");
  }

  void plan_programs() {
    const fs::path own = fs::path(request_.program).parent_path().parent_path();
    const fs::path folder = request_.installation.empty() ? own : fs::path(request_.installation);
    const Installation installation(
        fs::absolute(folder / "").lexically_normal().parent_path().string(), *plan_.architecture);
    std::vector<document::Reference> components = document_.libraries;
    std::erase_if(components, [](const document::Reference& library) {
      return library.name.find('/') != std::string::npos;
    });
    const ProgramFiles files = installation.files(components, folders_of(installation),
                                                  libraries_in_deployment_, diagnostics_);
    for (const auto& [place, file] : files.own) plan_.copies[place] = {file, {}};
    plan_.copies["LICENSE"] = {installation.licence(), {}};
    plan_packages(files.system);
  }

  /// Where the check has looked for component libraries; those of another machine are in its
  /// installation alone.
  std::vector<std::string> folders_of(const Installation& installation) const {
    if (plan_.foreign) return {installation.component_folder()};
    std::vector<std::string> first = request_.library_folders;
    first.push_back(installation.component_folder());
    return deploy::library_folders(first, request_.file);
  }

  void plan_packages(const std::map<std::string, std::string>& libraries) {
    if (!diagnostics_.ok()) return;
    Packages packages = packages_of(here(libraries));
    plan_.facts.packages = std::move(packages.names);
    plan_.facts.strangers = std::move(packages.strangers);
    for (const std::string& library : plan_.facts.strangers) {
      diagnostics_.note({}, "no Debian package on this machine has " + library +
                                ": install it on the target by hand");
    }
    plan_system(libraries);
  }

  /// Packages are called the same for every machine.
  std::map<std::string, std::string> here(std::map<std::string, std::string> libraries) const {
    for (auto& [library, file] : libraries) {
      if (file.empty() && here_ != nullptr) file = system_file("", library, *here_);
    }
    return libraries;
  }

  /// What the bundle's programs would run with here.
  void plan_system(const std::map<std::string, std::string>& libraries) {
    if (!plan_.foreign) return;
    plan_.system = request_.system.empty() ? "/usr/" + std::string(plan_.architecture->folder)
                                           : fs::absolute(request_.system).string();
    for (const auto& [library, file] : libraries) {
      if (!file.empty() || !system_file(plan_.system, library, *plan_.architecture).empty()) {
        continue;
      }
      diagnostics_.note({},
                        "the bundle was not checked by its own program, since this machine has "
                        "no " +
                            library + " for " + std::string(plan_.architecture->name) +
                            ": run bin/armature check on the target, or name a Debian for it "
                            "by --system (scripts/sysroot)");
      plan_.system.clear();
      return;
    }
  }

  void tell_of_run() {
    std::vector<std::string>& options = plan_.check_options;
    for (const std::string& override : request_.overrides) {
      options.insert(options.end(), {"--set", override});
    }
    if (!request_.mode.empty()) options.insert(options.end(), {"--mode", request_.mode});
    plan_.facts.options = options;
    plan_.facts.deployment = place_of(request_.file);
    if (!request_.script.empty()) plan_.facts.script = place_of(request_.script);
    plan_.facts.stop_time = document_.hold_at_stop.value_or(kUsualHold) + kTimeOfCommands;
  }

  std::string place_of(const std::string& file) const {
    return "deployment/" + file.substr(root_.size());
  }

  void choose_target() {
    const std::string usual =
        request_.package ? name_of_archive(plan_.facts) : plan_.facts.name + "-bundle";
    const fs::path target =
        fs::absolute(request_.out.empty() ? usual : request_.out).lexically_normal();
    plan_.target = (target.has_filename() ? target : target.parent_path()).string();
    std::error_code ignored;
    const bool taken = fs::exists(fs::symlink_status(plan_.target, ignored));
    if (!taken || is_ours(plan_.target)) return;
    diagnostics_.error({},
                       path_in_quotes(plan_.target) + " is there, and is no " +
                           (request_.package ? "package" : "bundle") + " of '" + plan_.facts.name +
                           "' that may be replaced",
                       "remove it, or name another place by --out");
  }

  bool is_ours(const fs::path& target) const {
    const std::string& name = plan_.facts.name;
    if (request_.package) return package_in(target.string()) == name_of_package(name);
    std::error_code ignored;
    return fs::is_directory(fs::symlink_status(target, ignored)) &&
           fs::exists(target / kSums, ignored) && fs::exists(target / name_of_unit(name), ignored);
  }

  const BundleRequest& request_;
  const document::Document& document_;
  base::Diagnostics& diagnostics_;
  std::string root_;  ///< of the deployment's files
  std::vector<std::string> libraries_in_deployment_;
  const Architecture* here_ = nullptr;  ///< this machine's; nullptr: none that bundles are for
  Plan plan_;
};

}  // namespace

std::optional<Plan> plan_bundle(const BundleRequest& request, const document::Document& document,
                                base::Diagnostics& diagnostics) {
  return Planner(request, document, diagnostics).plan();
}

}  // namespace armature::bundle::internal
