// SPDX-License-Identifier: Apache-2.0
#include "armature/record/timeline_writer.hpp"

#include <array>
#include <charconv>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "armature/platform/output_file.hpp"
#include "armature/record/internal/json_text.hpp"

namespace armature::record {
namespace {

using exec::TimelineSlice;

/// So much is handed to the system at once, and what is older than that time in any case.
constexpr std::size_t kTimelineBlock = 256u << 10;
constexpr base::Duration kInterval = std::chrono::seconds(1);

void append_number(std::uint64_t number, std::string& to) {
  std::array<char, 24> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number);
  to.append(text.data(), end.ptr);
}

/// Nanoseconds as microseconds: `12.345`.
void append_microseconds(std::int64_t ns, std::string& to) {
  const auto count = static_cast<std::uint64_t>(ns < 0 ? 0 : ns);
  append_number(count / 1000, to);
  const std::uint64_t rest = count % 1000;
  const char fraction[] = {'.', static_cast<char>('0' + rest / 100),
                           static_cast<char>('0' + rest / 10 % 10),
                           static_cast<char>('0' + rest % 10)};
  to.append(fraction, sizeof fraction);
}

/// So that a name is looked for without being copied.
struct TextHash {
  using is_transparent = void;
  std::size_t operator()(std::string_view text) const noexcept {
    return std::hash<std::string_view>()(text);
  }
};

class File final : public TimelineWriter {
 public:
  explicit File(platform::OutputFile file) : file_(std::move(file)) {
    text_ = R"([{"ph":"M","name":"process_name","pid":1,"args":{"name":"armature"}})";
  }
  ~File() override { static_cast<void>(File::close().ok()); }

  void add(const TimelineSlice& slice) override;
  base::Result<void> close() override;

 private:
  void introduce(std::size_t thread, std::string_view name);
  void add_stretch(const TimelineSlice& slice);
  void add_loss(const TimelineSlice& slice);
  void append_place(std::size_t thread, base::Time begin);
  void append_length(base::Duration length);
  const std::string& opening_of_step(std::string_view component);
  void write_text();

  platform::OutputFile file_;
  std::string text_;
  std::size_t events_ = 0;  ///< in `text_`
  std::uint64_t not_written_ = 0;
  std::optional<base::Error> failure_;
  base::Time written_at_{};
  bool closed_ = false;
  std::vector<bool> introduced_;                                                      ///< threads
  std::unordered_map<std::string, std::string, TextHash, std::equal_to<>> openings_;  ///< of steps
};

void File::add(const TimelineSlice& slice) {
  if (failure_ || closed_) {
    ++not_written_;
    return;
  }
  introduce(slice.thread, slice.thread_name);
  if (slice.kind == TimelineSlice::Kind::kStep) {
    text_ += opening_of_step(slice.component);
    append_place(slice.thread, slice.begin);
    append_length(slice.length);
    text_ += '}';
  } else if (slice.kind == TimelineSlice::Kind::kLost) {
    add_loss(slice);
  } else {
    add_stretch(slice);
  }
  ++events_;
  if (text_.size() >= kTimelineBlock || slice.begin >= written_at_ + kInterval) {
    written_at_ = slice.begin;
    write_text();
  }
}

void File::introduce(std::size_t thread, std::string_view name) {
  if (introduced_.size() <= thread) introduced_.resize(thread + 1);
  if (introduced_[thread]) return;
  introduced_[thread] = true;
  text_ += ",\n{\"ph\":\"M\",\"name\":\"thread_name\",\"pid\":1,\"tid\":";
  append_number(thread + 1, text_);
  text_ += R"(,"args":{"name":)";
  internal::append_json_string(name, text_);
  text_ += "}}";
}

const std::string& File::opening_of_step(std::string_view component) {
  const auto known = openings_.find(component);
  if (known != openings_.end()) return known->second;
  std::string opening = ",\n{\"ph\":\"X\",\"cat\":\"step\",\"name\":";
  internal::append_json_string(component, opening);
  return openings_.emplace(std::string(component), std::move(opening)).first->second;
}

void File::append_place(std::size_t thread, base::Time begin) {
  text_ += R"(,"pid":1,"tid":)";
  append_number(thread + 1, text_);
  text_ += R"(,"ts":)";
  append_microseconds(base::to_ns(begin), text_);
}

void File::append_length(base::Duration length) {
  text_ += R"(,"dur":)";
  append_microseconds(length.count(), text_);
}

void File::add_stretch(const TimelineSlice& slice) {
  const bool cycle = slice.kind == TimelineSlice::Kind::kCycle;
  text_ += cycle ? ",\n{\"ph\":\"X\",\"cat\":\"cycle\",\"name\":\"cycle\""
                 : ",\n{\"ph\":\"X\",\"cat\":\"messages\",\"name\":\"messages\"";
  append_place(slice.thread, slice.begin);
  append_length(slice.length);
  text_ += R"(,"args":{"cycle":)";
  append_number(slice.cycle, text_);
  text_ += R"(,"time_us":)";
  append_microseconds(base::to_ns(slice.cycle_time), text_);
  text_ += slice.detailed ? R"(,"steps":true)" : R"(,"steps":false)";
  if (slice.missing > 0) {
    text_ += R"(,"missing_before":)";
    append_number(slice.missing, text_);
  }
  text_ += "}}";
}

void File::add_loss(const TimelineSlice& slice) {
  text_ += ",\n{\"ph\":\"i\",\"s\":\"t\",\"cat\":\"lost\",\"name\":\"lost\"";
  append_place(slice.thread, slice.begin);
  text_ += R"(,"args":{"entries":)";
  append_number(slice.missing, text_);
  text_ += "}}";
}

void File::write_text() {
  if (const auto written = file_.write(text_); !written) {
    failure_ = base::Error{written.error()};
    not_written_ += events_;
  }
  text_.clear();
  events_ = 0;
}

base::Result<void> File::close() {
  if (std::exchange(closed_, true)) return {};
  if (!failure_) {
    text_ += "\n]\n";
    write_text();
  }
  const auto closed = file_.close();
  if (!failure_ && !closed) failure_ = base::Error{closed.error()};
  if (!failure_) return {};
  return base::Error{failure_->message + ": the timeline lacks " + std::to_string(not_written_) +
                     " events"};
}

}  // namespace

base::Result<std::unique_ptr<TimelineWriter>> TimelineWriter::create(const std::string& path) {
  auto file = platform::OutputFile::create(path);
  if (!file) return base::Error{file.error()};
  return std::unique_ptr<TimelineWriter>(std::make_unique<File>(std::move(file).value()));
}

}  // namespace armature::record
