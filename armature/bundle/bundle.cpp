// SPDX-License-Identifier: Apache-2.0
#include "armature/bundle/bundle.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <system_error>

#include "armature/bundle/internal/child.hpp"
#include "armature/bundle/internal/debian.hpp"
#include "armature/bundle/internal/plan.hpp"
#include "armature/bundle/internal/staging.hpp"
#include "armature/bundle/internal/texts.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/platform/file.hpp"

namespace armature::bundle {

using namespace internal;
namespace {

namespace fs = std::filesystem;
using document::path_in_quotes;

constexpr std::size_t kLargestFile = std::size_t{1} << 30;
/// In the folder where a package is made: what it has, and itself.
constexpr const char* kPackageRoot = "root";
constexpr const char* kPackage = "package.deb";

/// Makes what a plan says, each step if all before it went well.
class Maker {
 public:
  Maker(const Plan& plan, const BundleRequest& request, base::Diagnostics& diagnostics)
      : plan_(plan),
        request_(request),
        within_(request.package ? kPackageRoot + installed_folder(plan.facts.name) + "/" : ""),
        staging_(plan.target),
        diagnostics_(diagnostics) {}

  bool make() {
    if (!done(staging_.make()) || !fill() || !check()) return false;
    if (request_.package) return pack();
    staging_.set_times(time_of_files());
    return hand_over(staging_.folder());
  }

 private:
  bool fill() {
    for (const auto& [place, copy] : plan_.copies) add(place, copy);
    const Facts& facts = plan_.facts;
    add("run", run_script(facts), true);
    add(name_of_unit(facts.name), unit_text(facts), false);
    add("README", readme_text(facts), false);
    add("licences", licences_text(facts), false);
    if (diagnostics_.ok()) add_sums();
    return diagnostics_.ok();
  }

  void add(const std::string& place, const std::string& content, bool executable) {
    done(staging_.write(within_ + place, content, executable));
  }

  void add(const std::string& place, const Copy& copy) {
    const auto content = platform::read_file(copy.file, kLargestFile);
    if (!content) return diagnostics_.error(copy.where, content.error());
    if (place.starts_with("deployment/") &&
        content.value().find("PRIVATE KEY-----") != std::string::npos) {
      return diagnostics_.error(
          copy.where,
          path_in_quotes(copy.file) + " has a private key, which must not leave this machine",
          "keep the key in a file of its own, named by key: in network");
    }
    add(place, content.value(), place.starts_with("bin/"));
  }

  void add_sums() {
    std::vector<std::string> words{"/bin/sh", "-c",
                                   "cd \"$1\" && shift && exec sha256sum -- \"$@\"", "sh",
                                   staging_.folder() + "/" + within_};
    for (const std::string& place : staging_.places())
      words.push_back(place.substr(within_.size()));
    const Ran ran = run_program(words);
    if (ran.code != 0) return diagnostics_.error({}, "sha256sum has failed: " + ran.output);
    add(kSums, ran.output, false);
  }

  /// The bundle checks its deployment as it will on its target: from another folder, and without
  /// this account's environment.
  bool check() {
    const fs::path bundle = fs::path(staging_.folder()) / within_;
    std::vector<std::string> words{"/usr/bin/env", "--ignore-environment", "--chdir=/"};
    if (plan_.foreign && !add_emulator(words)) return true;
    words.insert(words.end(), {(bundle / "bin/armature").string(), "check",
                               (bundle / plan_.facts.deployment).string()});
    words.insert(words.end(), plan_.check_options.begin(), plan_.check_options.end());
    lend_keys(bundle);
    const Ran ran = run_program(words);
    take_back_keys(bundle);
    if (ran.code == 0) return true;
    diagnostics_.error({}, "the check fails in the bundle, though it passes here:\n" + ran.output);
    return false;
  }

  /// False if the programs of the bundle cannot run here.
  bool add_emulator(std::vector<std::string>& words) {
    const std::string emulator(plan_.architecture->emulator);
    if (plan_.system.empty()) return false;
    if (!fs::exists(emulator)) {
      diagnostics_.note(
          {}, "the bundle was not checked by its own program, since this machine has no " +
                  emulator + ": apt install qemu-user, or run bin/armature check on the target");
      return false;
    }
    words.insert(words.end(), {emulator, "-L", plan_.system});
    return true;
  }

  void lend_keys(const fs::path& bundle) {
    std::error_code ignored;
    for (const auto& [place, key] : plan_.keys) fs::create_symlink(key, bundle / place, ignored);
  }

  void take_back_keys(const fs::path& bundle) {
    std::error_code ignored;
    for (const auto& [place, key] : plan_.keys) fs::remove(bundle / place, ignored);
  }

  bool pack() {
    const Facts& facts = plan_.facts;
    const std::uint64_t kilobytes = staging_.size() / 1024 + 1;
    const std::string root = kPackageRoot + std::string("/");
    const std::string doc = root + "usr/share/doc/" + name_of_package(facts.name) + "/copyright";
    const std::string archive = staging_.folder() + "/" + kPackage;
    if (!done(staging_.write(root + "lib/systemd/system/" + name_of_unit(facts.name),
                             unit_text(facts), false)) ||
        !done(staging_.write(doc, licences_text(facts), false)) ||
        !done(staging_.write(root + "DEBIAN/control", control_text(facts, kilobytes), false))) {
      return false;
    }
    staging_.set_times(time_of_files());
    return done(build_package(staging_.folder() + "/" + kPackageRoot, archive)) &&
           hand_over(archive);
  }

  bool hand_over(const std::string& made) {
    if (request_.stopped()) diagnostics_.error({}, "stopped by a signal: nothing is made");
    return diagnostics_.ok() && done(staging_.hand_over(made));
  }

  bool done(const base::Result<void>& step) {
    if (!step) diagnostics_.error({}, step.error());
    return step.ok();
  }

  const Plan& plan_;
  const BundleRequest& request_;
  const std::string within_;  ///< the bundle's place in what is made, with a slash
  Staging staging_;
  base::Diagnostics& diagnostics_;
};

}  // namespace

std::string make_bundle(const BundleRequest& request, const document::Document& document,
                        base::Diagnostics& diagnostics) {
  const std::optional<Plan> plan = plan_bundle(request, document, diagnostics);
  if (!plan || !Maker(*plan, request, diagnostics).make()) return {};
  return plan->target;
}

}  // namespace armature::bundle

extern "C" {
extern armature::bundle::MakeBundle* const armature_bundle_make;
armature::bundle::MakeBundle* const armature_bundle_make = &armature::bundle::make_bundle;
}
