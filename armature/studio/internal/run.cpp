// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/run.hpp"

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <utility>

#include <nlohmann/json.hpp>

#include "armature/base/quoted.hpp"
#include "armature/platform/file.hpp"

namespace armature::studio::internal {
namespace {

std::string number_text(double value) { return nlohmann::json(value).dump(); }

/// What a file that grows has from byte `begin` on, at most a piece.
std::string part_of(const std::string& path, std::size_t begin) {
  constexpr std::size_t kPiece = 1 << 20;
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(begin));
  std::string text(kPiece, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

/// Whoever may start runs gives words of a command line by it: none of them may become an option.
base::Result<void> check_words(const RunOrder& order) {
  if (order.mode.starts_with('-')) {
    return base::Error{"the mode " + base::quoted(order.mode) + " must not begin with '-'"};
  }
  for (const std::string& setting : order.overrides) {
    const std::size_t name = setting.find('=');
    if (name != std::string::npos && name > 0 && !setting.starts_with('-')) continue;
    return base::Error{"expected NAME=VALUE to be set, found " + base::quoted(setting)};
  }
  return {};
}

}  // namespace

std::string_view name_of(RunStage stage) {
  switch (stage) {
    case RunStage::kNone:
      return "none";
    case RunStage::kStarting:
      return "starting";
    case RunStage::kRunning:
      return "running";
    case RunStage::kStopping:
      return "stopping";
    case RunStage::kEnded:
      return "ended";
  }
  return "?";
}

Run::Run(std::vector<std::string> command, std::string file, std::string folder)
    : command_(std::move(command)), file_(std::move(file)), folder_(std::move(folder)) {
  find_again();
}

std::vector<std::string> Run::command_of(const RunOrder& order) const {
  std::vector<std::string> command{command_.front(), "run", file_};
  command.insert(command.end(), command_.begin() + 1, command_.end());
  command.insert(command.end(), {"--listen", address()});
  if (order.simulated) command.emplace_back("--sim");
  if (order.simulated && std::isfinite(order.pace)) {
    command.insert(command.end(), {"--pace", number_text(order.pace)});
  }
  if (!order.mode.empty()) command.insert(command.end(), {"--mode", order.mode});
  for (const std::string& setting : order.overrides) {
    command.insert(command.end(), {"--set", setting});
  }
  return command;
}

base::Result<void> Run::start(const RunOrder& order) {
  if (!is_over()) return base::Error{"the application runs already: stop it first"};
  if (const auto good = check_words(order); !good) return good;
  if (order.simulated && !(order.pace > 0.0)) {
    return base::Error{"a pace is above 0: 1 is real time, 0.1 a tenth of it"};
  }
  std::error_code ignored;
  std::filesystem::remove(socket(), ignored);
  auto started =
      platform::ChildProcess::start(command_of(order), {.log = log_file(), .lasting = true});
  if (!started) return base::Error{started.error()};
  process_ = std::move(started.value());
  id_ = process_->id();
  stage_ = RunStage::kStarting;
  stopping_ = false;
  ++number_;
  simulated_ = order.simulated;
  version_ = order.version;
  exit_code_ = 0;
  kept_.begin_anew();
  rest_.clear();
  log_read_ = 0;
  write_note();
  return {};
}

void Run::write_note() const {
  const nlohmann::json note = {{"process", id_.load()}, {"simulated", simulated_}};
  // Without it a later studio does not find the run: no reason not to run.
  [[maybe_unused]] const auto written = platform::write_file(note_file(), note.dump());
}

void Run::find_again() {
  const auto text = platform::read_file(note_file());
  const auto note = nlohmann::json::parse(text ? text.value() : "", nullptr, false);
  if (!note.is_object()) return;
  const auto process = note.find("process");
  if (process == note.end() || !process->is_number_integer()) return;
  // Numbers of processes are given again: it is ours if it was told this socket.
  if (!platform::process_has_argument(process->get<int>(), address())) return;
  id_ = process->get<int>();
  simulated_ = note.value("simulated", false);
  stage_ = RunStage::kStarting;
  number_ = 1;
}

base::Result<void> Run::stop() {
  // The number of a process that has ended may be another one's by now.
  if (!platform::process_has_argument(id_, address())) return base::Error{"nothing runs"};
  platform::send_signal(id_, SIGTERM);
  stopping_ = true;
  return {};
}

std::optional<int> Run::ended() {
  if (process_) return process_->exit_code();
  if (platform::process_has_argument(id_, address())) return std::nullopt;
  return -1;
}

bool Run::look() {
  if (is_over()) return false;
  const auto code = ended();  // before the log, whose last line comes before the end
  const bool logged = read_log();
  if (!code) return logged;
  exit_code_ = *code;
  stage_ = RunStage::kEnded;
  process_.reset();
  std::error_code ignored;
  std::filesystem::remove(note_file(), ignored);
  return true;
}

bool Run::read_log() {
  const std::string text = part_of(log_file(), log_read_);
  if (text.empty()) return false;
  log_read_ += text.size();
  rest_ += text;
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = rest_.find('\n', begin)) != std::string::npos; begin = end + 1) {
    kept_.add(rest_.substr(begin, end - begin));
  }
  rest_.erase(0, begin);
  return true;
}

}  // namespace armature::studio::internal
