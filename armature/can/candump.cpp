// SPDX-License-Identifier: Apache-2.0
#include "armature/can/candump.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <utility>

#include "armature/base/result.hpp"

namespace armature::can {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;
constexpr std::int64_t kNsPerMicrosecond = 1'000;
constexpr std::size_t kMostDigits = 9;

std::string time_text(base::Time time) {
  const std::int64_t ns = base::to_ns(time);
  const std::int64_t fraction = ns % kNsPerSecond;
  std::array<char, 40> text{};
  if (fraction % kNsPerMicrosecond == 0) {
    std::snprintf(text.data(), text.size(), "(%010lld.%06lld)",
                  static_cast<long long>(ns / kNsPerSecond),
                  static_cast<long long>(fraction / kNsPerMicrosecond));
  } else {
    std::snprintf(text.data(), text.size(), "(%010lld.%09lld)",
                  static_cast<long long>(ns / kNsPerSecond), static_cast<long long>(fraction));
  }
  return text.data();
}

bool all_digits(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// A number of at most 18 digits.
bool parse_number(std::string_view digits, std::int64_t& value) {
  if (!all_digits(digits) || digits.size() > 18) return false;
  return std::from_chars(digits.data(), digits.data() + digits.size(), value).ec == std::errc{};
}

base::Result<base::Time> parse_time(std::string_view text) {
  const base::Error wrong{"expected a time such as (1436509052.249713), found '" +
                          std::string(text) + "'"};
  if (text.size() < 2 || text.front() != '(' || text.back() != ')') return wrong;
  text = text.substr(1, text.size() - 2);
  const std::size_t point = text.find('.');
  if (point == std::string_view::npos) return wrong;
  const std::string_view digits = text.substr(point + 1);
  std::int64_t seconds = 0;
  std::int64_t fraction = 0;
  if (digits.size() > kMostDigits || !parse_number(text.substr(0, point), seconds) ||
      !parse_number(digits, fraction)) {
    return wrong;
  }
  if (seconds >= std::numeric_limits<std::int64_t>::max() / kNsPerSecond) {
    return base::Error{"expected a time before the year 2262, found " + std::to_string(seconds) +
                       " seconds"};
  }
  for (std::size_t i = digits.size(); i < kMostDigits; ++i) fraction *= 10;
  return base::time_from_ns(seconds * kNsPerSecond + fraction);
}

/// Takes the next word off the front of `line`.
std::string_view take_word(std::string_view& line) {
  constexpr std::string_view kSpace = " \t\r";
  line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kSpace));
  line.remove_prefix(word.size());
  return word;
}

/// The entry of a line that is not empty; an error says what was expected.
base::Result<LogEntry> parse_line(std::string_view line) {
  const auto time = parse_time(take_word(line));
  if (!time) return base::Error{time.error()};
  const std::string_view bus = take_word(line);
  const std::string_view frame_text = take_word(line);
  if (frame_text.empty()) {
    return base::Error{"expected a bus and a frame such as can0 123#DEADBEEF behind the time"};
  }
  const auto frame = parse_frame(frame_text);
  if (!frame) return base::Error{frame.error()};
  const std::string_view direction = take_word(line);
  const bool known = direction.empty() || direction == "R" || direction == "T";
  if (!known || !take_word(line).empty()) {
    return base::Error{"expected the end of the line behind the frame, found '" +
                       std::string(direction) + "'"};
  }
  return LogEntry{time.value(), std::string(bus), frame.value()};
}

bool is_blank(std::string_view line) { return take_word(line).empty(); }

}  // namespace

std::string to_text(const LogEntry& entry) {
  return time_text(entry.time) + " " + entry.bus + " " + std::string(to_text(entry.frame).view());
}

std::string to_text(const std::vector<LogEntry>& entries) {
  std::string text;
  for (const LogEntry& entry : entries) text += to_text(entry) + "\n";
  return text;
}

std::vector<LogEntry> parse_candump(std::string_view text, const std::string& file,
                                    base::Diagnostics& diagnostics) {
  std::vector<LogEntry> entries;
  bool ok = true;
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (is_blank(line)) continue;
    auto entry = parse_line(line);
    if (entry) {
      entries.push_back(std::move(entry).value());
    } else {
      ok = false;
      diagnostics.error({file, number, 0}, entry.error(), "write logs with candump -l");
    }
  }
  if (!ok) entries.clear();
  return entries;
}

LogPlayer::LogPlayer(std::string name, std::vector<LogEntry> log, Clock clock)
    : Bus(std::move(name)), log_(std::move(log)), clock_(std::move(clock)) {
  if (this->name().empty()) return;
  std::erase_if(log_, [this](const LogEntry& entry) { return entry.bus != this->name(); });
}

bool LogPlayer::open(const BusOptions& options, base::Diagnostics& diagnostics) {
  if (open_) {
    diagnostics.error({}, "bus '" + name() + "' is open already", "close it first");
    return false;
  }
  if (!check_options(name(), options, diagnostics)) return false;
  if (log_.empty()) {
    diagnostics.error({}, "bus '" + name() + "' is not in the log",
                      "look for the buses' names behind the times");
    return false;
  }
  options_ = options;
  next_ = 0;
  offset_ = clock_() - log_.front().time;
  open_ = true;
  return true;
}

void LogPlayer::close() { open_ = false; }

SendStatus LogPlayer::send(const Frame& frame) {
  if (!can_be_sent(frame)) return tally_.answer(SendStatus::kInvalid);
  return tally_.answer(open_ ? SendStatus::kSent : SendStatus::kDown);
}

ReceiveStatus LogPlayer::receive(Arrival& arrival) {
  if (!open_) return ReceiveStatus::kDown;
  const base::Time now = clock_();
  while (next_ < log_.size() && log_[next_].time + offset_ <= now) {
    const LogEntry& entry = log_[next_++];
    if (entry.frame.kind == FrameKind::kError) internal::Tally::add(tally_.error_frames);
    if (!passes(options_, entry.frame)) continue;
    internal::Tally::add(tally_.received);
    arrival = {entry.frame, entry.time + offset_, false};
    return ReceiveStatus::kReceived;
  }
  return ReceiveStatus::kNothing;
}

BusState LogPlayer::state() const { return open_ ? BusState::kActive : BusState::kClosed; }

}  // namespace armature::can
