// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/desk.hpp"

#include <filesystem>
#include <utility>

#include <nlohmann/json.hpp>

#include "armature/document/limits.hpp"
#include "armature/edit/save_files.hpp"
#include "armature/platform/file.hpp"
#include "armature/platform/sockets/stream_socket.hpp"

namespace armature::studio::internal {

using Json = nlohmann::json;

namespace {

std::string as_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// A file that is not there has no text yet.
base::Result<std::string> read_from_disk(const std::string& path) {
  if (!std::filesystem::exists(path)) return std::string();
  return platform::read_file(path, document::Limits{}.file_bytes);
}

std::vector<std::string> with(std::vector<std::string> words,
                              const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// The file that lets this studio do everything to its runs: whoever reaches them otherwise may do
/// what the deployment's own policy says.
std::string policy_for(const Desk::Options& options) {
  const std::string path = options.folder + "/run.policy";
  // Without it the studio may only look at its runs, which say so.
  [[maybe_unused]] const auto written = platform::write_file(
      path, "allow local:" + platform::own_account() + " read,command,configure *\n");
  return path;
}

/// What a check that never came to its end has found, in the form of one that did.
std::string findings_of_failure(const std::string& file, const std::string& why) {
  return as_text({{"format", 1},
                  {"file", file},
                  {"application", ""},
                  {"ok", false},
                  {"errors", 1},
                  {"diagnostics", {{{"severity", "error"}, {"message", why}}}},
                  {"components", Json::array()},
                  {"connections", Json::array()},
                  {"threads", Json::array()},
                  {"modes", Json::array()}});
}

}  // namespace

Desk::Desk(const Options& options, Listeners listeners)
    : options_(options),
      listeners_(std::move(listeners)),
      project_(options.file, {&read_from_disk, &edit::save_files}),
      journal_(options.folder + "/unsaved.json"),
      checker_(with({options.program, "check", "--serve"}, options.arguments)),
      run_(with(with({options.program}, options.arguments), {"--policy", policy_for(options)}),
           options.file, options.folder) {
  notice_ = project_.restore(journal_.left());
  known_version_ = project_.version();
  check();
}

base::Diagnostics Desk::edit(const std::vector<WordedChange>& changes,
                             const std::vector<std::string>& files, bool overrides) {
  base::Diagnostics diagnostics = project_.edit(changes, files, overrides);
  after_change();
  return diagnostics;
}

base::Result<void> Desk::told(base::Result<void> result) {
  after_change();
  return result;
}

base::Result<void> Desk::write(std::int32_t version, const std::string& path,
                               const std::string& text) {
  return told(project_.write(version, path, text));
}

base::Result<void> Desk::undo() { return told(project_.undo()); }

base::Result<void> Desk::redo() { return told(project_.redo()); }

base::Result<void> Desk::save() {
  look_at_disk();
  auto saved = project_.save();
  if (saved) notice_.clear();
  [[maybe_unused]] const auto kept = journal_.keep(project_.unsaved());
  listeners_.project();
  return saved;
}

base::Result<void> Desk::reload() {
  checker_.renew();
  project_.reload();
  notice_.clear();
  after_change();
  check();
  listeners_.project();
  return {};
}

void Desk::after_change() {
  if (std::exchange(known_version_, project_.version()) == project_.version()) return;
  if (const auto kept = journal_.keep(project_.unsaved()); !kept) {
    notice_ = "what is not saved would be lost with the studio: " + kept.error();
  }
  check();
  listeners_.project();
}

/// One check at a time: what changes meanwhile is checked after it.
void Desk::check() {
  if (std::exchange(checking_, true)) return;
  Json texts = Json::object();
  for (const auto& [path, file] : project_.files()) {
    if (file.is_changed() || path == project_.file()) texts[path] = file.text;
  }
  const std::int32_t version = project_.version();
  checker_.ask(as_text({{"do", "check"}, {"file", project_.file()}, {"texts", texts}}),
               [this, version](base::Result<std::string> result) {
                 take_findings(version, std::move(result));
               });
}

void Desk::take_findings(std::int32_t version, base::Result<std::string> result) {
  checking_ = false;
  checked_ = version;
  findings_ =
      result ? std::move(result.value()) : findings_of_failure(project_.file(), result.error());
  if (project_.version() != version) check();
  listeners_.project();
}

void Desk::ask_fitting(const std::string& component, const std::string& member,
                       Checker::Then then) {
  checker_.ask(
      as_text({{"do", "fitting"}, {"component", component}, {"member", member}, {"models", true}}),
      std::move(then));
}

void Desk::ask_models(Checker::Then then) {
  checker_.ask(as_text({{"do", "models"}}), std::move(then));
}

base::Result<void> Desk::start(RunOrder order) {
  if (!project_.is_saved()) {
    return base::Error{
        "what runs is what the disk has, and some of it is not saved: save it first"};
  }
  order.version = project_.version();
  auto started = run_.start(order);
  listeners_.run();
  return started;
}

void Desk::look_at_run() {
  if (run_.look()) listeners_.run();
}

void Desk::look_at_disk() {
  if (const std::string news = project_.take_from_disk(); !news.empty()) {
    notice_ = news;
    after_change();
    listeners_.project();
  }
}

}  // namespace armature::studio::internal
