// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/checker.hpp"

#include <utility>

#include <nlohmann/json.hpp>

namespace armature::studio::internal {
namespace {

constexpr std::string_view kResult = R"({"id":0,"result":)";

/// The result in an answer's line, which may be long: it is not read, only cut out.
base::Result<std::string> result_of(const std::string& line) {
  if (line.starts_with(kResult)) {
    return line.substr(kResult.size(), line.size() - kResult.size() - 1);
  }
  const auto json = nlohmann::json::parse(line, nullptr, false);
  return base::Error{json.is_object() ? json.value("error", "no answer") : "no answer"};
}

bool is_answer(const std::string& line) { return line.starts_with(R"({"id":)"); }

}  // namespace

void Checker::ask(std::string request, Then then) {
  request.insert(1, R"("id":0,)");
  requests_.push_back({request + '\n', std::move(then)});
  send_next();
}

void Checker::send_next() {
  if (asked_ || requests_.empty()) return;
  if (std::exchange(renew_, false)) process_.reset();
  if (!process_) {
    auto started = platform::ChildProcess::start(command_, {.piped = true});
    if (!started) return fail(started.error());
    process_ = std::move(started.value());
    came_.clear();
  }
  asked_ = true;
  process_->write(requests_.front().line);  // that it has ended is heard from its output
}

void Checker::take() {
  if (!process_) return;
  const auto text = process_->read();
  if (text) {
    came_ += *text;
    return take_lines();
  }
  process_.reset();
  if (asked_) {
    fail(
        "the check ended before it answered: a component library has crashed. Its last words are "
        "at the terminal of the studio; build it anew, then Reload");
  }
}

void Checker::take_lines() {
  std::size_t end = 0;
  while ((end = came_.find('\n')) != std::string::npos) {
    const std::string line = came_.substr(0, end);
    came_.erase(0, end + 1);
    // Libraries may print, too.
    if (asked_ && is_answer(line)) answer(line);
  }
}

void Checker::answer(const std::string& line) {
  asked_ = false;
  const Then then = std::move(requests_.front().then);
  requests_.pop_front();
  then(result_of(line));
  send_next();
}

void Checker::fail(const std::string& why) {
  asked_ = false;
  const Then then = std::move(requests_.front().then);
  requests_.pop_front();
  then(base::Error{why});
  send_next();
}

void Checker::renew() { renew_ = true; }

}  // namespace armature::studio::internal
