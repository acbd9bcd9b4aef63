// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/elsewhere/bench.hpp"

#include <memory>

#include "armature/studio/internal/description.hpp"

namespace armature::studio::internal {
namespace {

constexpr std::size_t kLinesAtOnce = 500;

}  // namespace

void ElsewhereBench::refuse() const {
  throw ride::Failure("this application runs at " + application_.address() +
                      ": open its file to change it");
}

void ElsewhereBench::project(ride::ReplyOf<ProjectState> reply) {
  const Elsewhere::State now = application_.state();
  ProjectState state;
  state.file = state.elsewhere = application_.address();
  state.version = state.checked = now.version;
  if (!now.there) {
    state.notice = "The application at " + application_.address() + " is not there (" +
                   now.trouble + "). It is shown as it was last. The page goes on when it is back.";
  }
  reply.put(state);
}

void ElsewhereBench::text(const std::string&, ride::ReplyOf<std::string>) { refuse(); }

void ElsewhereBench::edit(const Edit&, ride::ReplyOf<Outcome>) { refuse(); }

void ElsewhereBench::write(std::int32_t, const std::string&, const std::string&,
                           ride::ReplyOf<Outcome>) {
  refuse();
}

void ElsewhereBench::undo(ride::ReplyOf<Outcome>) { refuse(); }

void ElsewhereBench::redo(ride::ReplyOf<Outcome>) { refuse(); }

void ElsewhereBench::save(ride::ReplyOf<Outcome>) { refuse(); }

void ElsewhereBench::reload(ride::ReplyOf<Outcome> reply) {
  application_.read_anew();
  reply.put({true, application_.state().version, "[]"});
}

void ElsewhereBench::check(ride::ReplyOf<std::string> reply) {
  reply.put(application_.description());
}

void ElsewhereBench::fitting(const std::string&, const std::string&, ride::ReplyOf<std::string>) {
  refuse();
}

void ElsewhereBench::models(ride::ReplyOf<std::string> reply) {
  const auto owed = std::make_shared<ride::PendingReplyOf<std::string>>(reply.keep());
  const auto told = [owed](const base::Result<std::string>& result) {
    if (!result) return owed->fail(result.error());
    owed->put(result.value());
  };
  // Let go of, a reply that is owed tells so.
  [[maybe_unused]] const bool taken =
      queue().post([this, told] { checker_.ask(R"({"do": "models"})", told); });
  wake();
}

void ElsewhereBench::places(ride::ReplyOf<std::string> reply) {
  reply.put(std::string(R"({"boxes": {}})"));
}

void ElsewhereBench::start(const RunSettings&, ride::ReplyOf<RunState>) { refuse(); }

void ElsewhereBench::stop(ride::ReplyOf<RunState>) {
  throw ride::Failure("this application runs at " + application_.address() +
                      ": it is stopped there; E-stop disarms it from here");
}

void ElsewhereBench::run(ride::ReplyOf<RunState> reply) {
  const Elsewhere::State now = application_.state();
  const char* const state = !now.there ? "lost" : ready_() ? "running" : "starting";
  reply.put({now.number, state, now.simulated, now.version, 0, now.log_begin, now.log_end});
}

void ElsewhereBench::log(std::int32_t from, ride::ReplyOf<std::vector<std::string>> reply) {
  reply.put(application_.log(from, kLinesAtOnce));
}

void ElsewhereBench::description(const std::string& path, ride::ReplyOf<std::string> reply) {
  later(reply, [this, path](auto& owed) {
    auto text = read_description(path, application_.description());
    if (!text) throw ride::Failure(text.error());
    owed.put(std::move(text.value()));
  });
}

void ElsewhereBench::tell_project() {
  const std::int32_t version = application_.state().version;
  publish(ProjectChanged{version, version});
}

void ElsewhereBench::tell_run() {
  const Elsewhere::State now = application_.state();
  publish(RunChanged{now.number, now.log_end});
}

}  // namespace armature::studio::internal
