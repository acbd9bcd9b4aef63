// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/elsewhere/application.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/inspect/running_json.hpp"

namespace armature::studio::internal {
namespace {

using namespace std::chrono_literals;

/// Between two questions.
constexpr base::Duration kPeriod = 150ms;

ride::NodeOptions node_options(const Elsewhere::Options& options) {
  ride::NodeOptions node;
  node.name = "armature studio";
  node.log = options.log;
  node.transports = options.transports;
  return node;
}

/// As a run of this machine writes it.
std::string line_of(const exec::LogLine& line) {
  const std::string level(rt::name_of(line.level));
  char head[64];
  std::snprintf(head, sizeof head, "%12.6f %-7s ", base::to_seconds(line.time - base::Time{}),
                level.c_str());
  return head + line.component + ": " + line.text;
}

/// What lets a studio in, where it is the policy that does not.
std::string with_way_out(std::string why) {
  const bool refused = why.starts_with("not allowed");
  return refused ? why + " (a line such as `allow WHO read *` in its policy lets a studio in)"
                 : why;
}

}  // namespace

Elsewhere::Elsewhere(Options options)
    : options_(std::move(options)),
      node_(node_options(options_)),
      peer_(node_.connect(options_.address)),
      view_(peer_) {}

Elsewhere::~Elsewhere() {
  {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
  }
  ended_or_anew_.notify_all();
  if (thread_.joinable()) thread_.join();
}

base::Result<void> Elsewhere::find(base::Duration limit) {
  if (auto there = view_.wait_until_connected(limit); !there) return there;
  try {
    [[maybe_unused]] const auto known = view_.take_changes();
    describe(true);
    take_log();
  } catch (const inspect::NoAnswer& failure) {
    return base::Error{"'" + address() + "': " + with_way_out(failure.what())};
  }
  thread_ = std::thread([this] { attend(); });
  return {};
}

void Elsewhere::read_anew() {
  {
    const std::scoped_lock lock(mutex_);
    anew_ = true;
  }
  ended_or_anew_.notify_all();
}

Elsewhere::State Elsewhere::state() const {
  const std::scoped_lock lock(mutex_);
  State state = state_;
  state.log_begin = log_.begin();
  state.log_end = log_.end();
  return state;
}

std::string Elsewhere::description() const {
  const std::scoped_lock lock(mutex_);
  return description_;
}

std::vector<std::string> Elsewhere::log(std::int32_t from, std::size_t count) const {
  const std::scoped_lock lock(mutex_);
  return log_.lines(from, count);
}

// --- its thread ----------------------------------------------------------------------------------

void Elsewhere::attend() {
  std::unique_lock lock(mutex_);
  while (!ending_) {
    lock.unlock();
    try {
      ask_for_news();
    } catch (const inspect::Refusal& busy) {
      // It answers, and has too much to do for that: it is asked again.
      if (!state().there) lose(busy.what());
    } catch (const inspect::NoAnswer& failure) {
      lose(failure.what());
    }
    tell();
    lock.lock();
    ended_or_anew_.wait_for(lock, kPeriod, [this] { return ending_ || anew_; });
  }
}

void Elsewhere::ask_for_news() {
  const auto changes = view_.take_changes();
  const auto lost = std::ranges::find(changes, false, &ride::PeerChange::connected);
  if (!view_.connected()) {
    return lose(lost == changes.end() ? "it does not answer" : lost->text);
  }
  const bool there = state().there;
  bool anew = false;
  {
    const std::scoped_lock lock(mutex_);
    anew = std::exchange(anew_, false);
  }
  // What was lost meanwhile may be another application by now.
  const bool came = !there || lost != changes.end();
  if (came || anew || !changes.empty()) describe(came);
  take_log();
}

void Elsewhere::describe(bool came) {
  view_.forget();
  if (!view_.has_application()) {
    throw inspect::NoAnswer(
        "a node is there, and no application that can be looked at (its policy may hide it)");
  }
  const bool simulated = view_.status().simulated;
  std::string description = inspect::running_as_json(view_, address());
  if (came) last_line_ = 0;
  const std::scoped_lock lock(mutex_);
  description_ = std::move(description);
  ++state_.version;
  state_.simulated = simulated;
  state_.trouble.clear();
  state_.there = true;
  if (!came) return;
  ++state_.number;
  log_.begin_anew();
}

void Elsewhere::take_log() {
  const inspect::LogLines news = view_.log(last_line_);
  if (news.lines.empty()) return;
  const std::scoped_lock lock(mutex_);
  for (const exec::LogLine& line : news.lines) log_.add(line_of(line));
  last_line_ = news.lines.back().number;
}

void Elsewhere::lose(const std::string& why) {
  const std::scoped_lock lock(mutex_);
  // The first reason is the one that tells: later ones are of attempts to come back.
  if (!std::exchange(state_.there, false) && !state_.trouble.empty()) return;
  state_.trouble = why;
}

void Elsewhere::tell() {
  const State now = state();
  if (std::exchange(told_, now) != now) options_.wake();
}

}  // namespace armature::studio::internal
