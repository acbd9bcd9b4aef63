// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/workbench.hpp"

#include <utility>

#include "armature/inspect/checked_json.hpp"
#include "armature/platform/file.hpp"
#include "armature/studio/internal/description.hpp"

namespace armature::studio::internal {
namespace {

constexpr std::size_t kLogLinesAtOnce = 500;

}  // namespace

/// What changes texts, at the desk: the reply is what became of it.
template <typename Work>
void Workbench::change(ride::ReplyOf<Outcome>& reply, Work work) {
  later(reply, [this, work = std::move(work)](auto& owed) { owed.put(outcome_of(work(desk_))); });
}

Outcome Workbench::outcome_of(const base::Diagnostics& diagnostics) const {
  const auto read = [this](const std::string& path) -> base::Result<std::string> {
    if (const std::string* text = desk_.project().text(path)) return *text;
    return platform::read_file(path);
  };
  return {diagnostics.ok(), desk_.project().version(),
          inspect::diagnostics_as_json(diagnostics, read)};
}

Outcome Workbench::outcome_of(const base::Result<void>& result) const {
  base::Diagnostics diagnostics;
  if (!result) diagnostics.error(base::Location{}, result.error());
  return outcome_of(diagnostics);
}

ProjectState Workbench::project_state() const {
  const Project& project = desk_.project();
  ProjectState state;
  state.file = project.file();
  state.version = project.version();
  // The deployment's own file first, then those that it includes.
  state.files.push_back({project.file(), project.files().at(project.file()).is_changed()});
  for (const auto& [path, file] : project.files()) {
    if (path != project.file()) state.files.push_back({path, file.is_changed()});
  }
  state.undo = project.undo_text();
  state.redo = project.redo_text();
  state.checked = desk_.checked();
  state.notice = desk_.notice();
  return state;
}

RunState Workbench::run_state() const {
  const Run& run = desk_.run();
  return {run.number(),       std::string(name_of(run.stage())),
          run.is_simulated(), run.version(),
          run.exit_code(),    run.log_begin(),
          run.log_end()};
}

void Workbench::project(ride::ReplyOf<ProjectState> reply) {
  later(reply, [this](auto& owed) { owed.put(project_state()); });
}

void Workbench::text(const std::string& path, ride::ReplyOf<std::string> reply) {
  later(reply, [this, path](auto& owed) {
    const std::string* const text = desk_.project().text(path);
    if (text == nullptr) throw ride::Failure("'" + path + "' is no file of this deployment");
    owed.put(*text);
  });
}

void Workbench::edit(const Edit& what, ride::ReplyOf<Outcome> reply) {
  change(reply, [what](Desk& desk) {
    std::vector<WordedChange> changes;
    for (const Change& change : what.changes) changes.push_back({change.edit, change.words});
    return desk.edit(changes, what.files, what.overrides);
  });
}

void Workbench::write(std::int32_t version, const std::string& path, const std::string& text,
                      ride::ReplyOf<Outcome> reply) {
  change(reply, [version, path, text](Desk& desk) { return desk.write(version, path, text); });
}

void Workbench::undo(ride::ReplyOf<Outcome> reply) {
  change(reply, [](Desk& desk) { return desk.undo(); });
}

void Workbench::redo(ride::ReplyOf<Outcome> reply) {
  change(reply, [](Desk& desk) { return desk.redo(); });
}

void Workbench::save(ride::ReplyOf<Outcome> reply) {
  change(reply, [](Desk& desk) { return desk.save(); });
}

void Workbench::reload(ride::ReplyOf<Outcome> reply) {
  change(reply, [](Desk& desk) { return desk.reload(); });
}

void Workbench::check(ride::ReplyOf<std::string> reply) {
  later(reply, [this](auto& owed) { owed.put(desk_.findings()); });
}

/// What the check answers goes to who asked, as it is.
Checker::Then Workbench::forward(ride::ReplyOf<std::string>& reply) {
  const auto owed = std::make_shared<ride::PendingReplyOf<std::string>>(reply.keep());
  return [owed](const base::Result<std::string>& result) {
    if (result) {
      owed->put(result.value());
    } else {
      owed->fail(result.error());
    }
  };
}

void Workbench::fitting(const std::string& component, const std::string& member,
                        ride::ReplyOf<std::string> reply) {
  // Let go of, a reply that is owed tells so.
  [[maybe_unused]] const bool taken =
      queue().post([this, component, member, then = forward(reply)] {
        desk_.ask_fitting(component, member, then);
      });
  wake();
}

void Workbench::models(ride::ReplyOf<std::string> reply) {
  [[maybe_unused]] const bool taken =
      queue().post([this, then = forward(reply)] { desk_.ask_models(then); });
  wake();
}

void Workbench::places(ride::ReplyOf<std::string> reply) {
  later(reply, [this](auto& owed) {
    const std::string& text = *desk_.project().text(desk_.project().places_file());
    owed.put(text.empty() ? R"({"boxes": {}})" : text);
  });
}

/// Whoever sets something for a run configures; and it may be a word of the operator.
void Workbench::start(const RunSettings& settings, ride::ReplyOf<RunState> reply) {
  if (!settings.overrides.empty()) {
    reply.demand(kName, ride::Access::kConfigure);
    const auto sits = seats().demand(reply.origin());
    if (!sits) throw ride::Failure("overrides are the operator's: " + sits.error());
  }
  later(reply, [this, settings](auto& owed) {
    const auto started =
        desk_.start({settings.simulated, settings.pace, settings.mode, settings.overrides, 0});
    if (!started) throw ride::Failure(started.error());
    owed.put(run_state());
  });
}

/// Here and now: what waits at the desk is not waited for.
void Workbench::stop(ride::ReplyOf<RunState> reply) {
  const auto stopped = desk_.run().stop();
  if (!stopped) throw ride::Failure(stopped.error());
  later(reply, [this](auto& owed) {
    desk_.tell_of_run();
    owed.put(run_state());
  });
}

void Workbench::run(ride::ReplyOf<RunState> reply) {
  later(reply, [this](auto& owed) { owed.put(run_state()); });
}

void Workbench::log(std::int32_t from, ride::ReplyOf<std::vector<std::string>> reply) {
  later(reply, [this, from](auto& owed) { owed.put(desk_.run().log(from, kLogLinesAtOnce)); });
}

void Workbench::description(const std::string& path, ride::ReplyOf<std::string> reply) {
  later(reply, [this, path](auto& owed) {
    auto text = read_description(path, desk_.findings());
    if (!text) throw ride::Failure(text.error());
    owed.put(std::move(text.value()));
  });
}

void Workbench::tell_project() {
  publish(ProjectChanged{desk_.project().version(), desk_.checked()});
}

void Workbench::tell_run() { publish(RunChanged{desk_.run().number(), desk_.run().log_end()}); }

}  // namespace armature::studio::internal
