// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/platform/child_process.hpp"
#include "armature/studio/internal/kept_lines.hpp"

namespace armature::studio::internal {

/// What a run is asked for.
struct RunOrder {
  bool simulated = false;
  double pace = 0.0;  ///< simulated seconds in a second; infinite: as fast as the machine can
  std::string mode{};
  std::vector<std::string> overrides{};
  std::int32_t version = 0;  ///< of the texts that it runs
};

/// Where a run is.
enum class RunStage { kNone, kStarting, kRunning, kStopping, kEnded };

/// The application that a studio runs, as a process of its own: `armature run`. It goes on when the
/// studio ends, however that ends, and another studio of the same deployment finds it again.
/// @thread one
class Run {
 public:
  /// Finds the run that an earlier studio has left.
  /// @param command  the program, and arguments for every run behind `run FILE`
  /// @param folder   for what a run leaves: its socket, its log, which process it is
  Run(std::vector<std::string> command, std::string file, std::string folder);

  /// The error: one runs, or the program cannot be started.
  base::Result<void> start(const RunOrder& order);
  /// Asks it to stop in order, at once, whatever this thread is about; the second time it ends
  /// without order. The error: none runs.
  /// @thread any
  base::Result<void> stop();
  /// Looks what has become of it, and what it has logged.
  /// @return true if something is other than before
  bool look();
  /// It answers at its address.
  void set_answers() {
    if (stage_ == RunStage::kStarting) stage_ = RunStage::kRunning;
  }

  RunStage stage() const { return !is_over() && stopping_ ? RunStage::kStopping : stage_; }
  bool is_over() const { return stage_ == RunStage::kNone || stage_ == RunStage::kEnded; }
  std::int32_t number() const { return number_; }
  bool is_simulated() const { return simulated_; }
  std::int32_t version() const { return version_; }
  /// -1: nobody knows, since an earlier studio has started it.
  int exit_code() const { return exit_code_; }
  /// Its number; of a run that is over, too.
  int process() const { return id_; }
  std::string address() const { return "unix:" + socket(); }

  std::int32_t log_begin() const { return kept_.begin(); }
  std::int32_t log_end() const { return kept_.end(); }
  /// From line `from` on, at most `count`.
  std::vector<std::string> log(std::int32_t from, std::size_t count) const {
    return kept_.lines(from, count);
  }

 private:
  std::string socket() const { return folder_ + "/run.sock"; }
  std::string log_file() const { return folder_ + "/run.log"; }
  std::string note_file() const { return folder_ + "/run.json"; }

  std::vector<std::string> command_of(const RunOrder& order) const;
  void write_note() const;
  void find_again();
  bool read_log();
  std::optional<int> ended();

  const std::vector<std::string> command_;
  const std::string file_;
  const std::string folder_;
  std::optional<platform::ChildProcess> process_;
  /// Of the process, also of one that an earlier studio has started.
  std::atomic<int> id_{0};
  std::atomic<bool> stopping_{false};
  RunStage stage_ = RunStage::kNone;
  std::int32_t number_ = 0;
  bool simulated_ = false;
  std::int32_t version_ = 0;
  int exit_code_ = 0;
  KeptLines kept_;
  std::size_t log_read_ = 0;  ///< bytes of the log's file
  std::string rest_;          ///< of a line that is not whole yet
};

/// `starting`, `running`, ...
std::string_view name_of(RunStage stage);

}  // namespace armature::studio::internal
