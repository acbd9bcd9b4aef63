// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/can/bus.hpp"
#include "armature/can/frame.hpp"
#include "armature/can/internal/tally.hpp"

namespace armature::can {

/// A line of a log as `candump -l` writes it: `(1436509052.249713) can0 123#DEADBEEF`.
struct LogEntry {
  base::Time time{};  ///< on the log's own clock; candump's counts from 1970
  std::string bus;
  Frame frame;

  friend bool operator==(const LogEntry&, const LogEntry&) = default;
};

/// The entry as a line without its end; the time has six digits after the point, nine if it is not
/// a whole number of microseconds.
std::string to_text(const LogEntry& entry);
std::string to_text(const std::vector<LogEntry>& entries);

/// The entries of a log, in the order of the file. Empty lines are left out, and so is the
/// direction
/// (`R` or `T`) that some versions of candump write last.
/// @param file  the name for diagnostics; each error has its line and says what was expected
/// @return empty after an error
std::vector<LogEntry> parse_candump(std::string_view text, const std::string& file,
                                    base::Diagnostics& diagnostics);

/// Plays a log back: what the log has of one bus is received at its time. What is sent is counted
/// and goes nowhere, since the log already has the answers.
class LogPlayer final : public Bus {
 public:
  using Clock = std::function<base::Time()>;

  /// @param name   the bus in the log whose frames are played; empty: those of all
  /// @param clock  the time that it is; when the bus is opened, the first entry's time is now
  LogPlayer(std::string name, std::vector<LogEntry> log, Clock clock);

  bool open(const BusOptions& options, base::Diagnostics& diagnostics) override;
  void close() override;
  SendStatus send(const Frame& frame) override;
  /// Nobody tells news: a log has no thread of its own, so look as often as the time is of
  /// interest.
  ReceiveStatus receive(Arrival& arrival) override;
  BusState state() const override;
  RestartStatus restart() override { return RestartStatus::kNotNeeded; }
  BusCounters counters() const override { return tally_.now(); }

  /// Whether everything was received.
  bool finished() const { return next_ == log_.size(); }

 private:
  std::vector<LogEntry> log_;
  const Clock clock_;
  BusOptions options_;
  internal::Tally tally_;
  std::atomic<bool> open_{false};
  std::size_t next_ = 0;
  base::Duration offset_{};  // from the log's clock to this one
};

/// Collects frames and makes a log of them.
/// @thread one only, and none that is real-time: it allocates
class LogWriter {
 public:
  explicit LogWriter(std::string bus) : bus_(std::move(bus)) {}

  /// @param time  since when the log's time counts is the caller's business
  void add(base::Time time, const Frame& frame) { entries_.push_back({time, bus_, frame}); }
  const std::vector<LogEntry>& entries() const { return entries_; }
  std::string text() const { return to_text(entries_); }

 private:
  const std::string bus_;
  std::vector<LogEntry> entries_;
};

}  // namespace armature::can
