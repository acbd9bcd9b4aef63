// SPDX-License-Identifier: Apache-2.0
#include "armature/record/mcap_reader.hpp"

#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "armature/platform/file.hpp"
#include "armature/record/cdr.hpp"
#include "armature/record/internal/compression.hpp"
#include "armature/record/internal/mcap_format.hpp"
#include "armature/record/json.hpp"

namespace armature::record {
namespace {

using internal::mcap::Cursor;
using internal::mcap::kMagic;
using internal::mcap::Op;

constexpr std::size_t kLargestFile = std::size_t{4} << 30;

class Reader {
 public:
  Reader(std::string_view content, const std::string& file) : whole_(content) {
    recording_.file = file;
  }

  bool read() {
    return read_ends() && read_footer() && check_summary() && read_data() && check_statistics();
  }

  /// The same of a file that may have no end.
  bool read_whole_records() {
    if (is_closed()) return read();
    recording_.closed = false;
    if (!whole_.starts_with(kMagic)) return fail(whole_, "the magic bytes of an MCAP file");
    Cursor cursor(whole_.substr(kMagic.size()));
    Op op{};
    std::string_view content;
    for (bool first = true; op != Op::kDataEnd; first = false) {
      const std::string_view here = cursor.rest();
      if (!cursor.take_record(op, content)) return !first || fail(here, "a whole header");
      if (first && op != Op::kHeader) return fail(here, "the header");
      if (!read_record(op, content)) return false;
    }
    return true;
  }

  McapRecording take_recording() { return std::move(recording_); }

  base::Error problem() const {
    return base::Error{"cannot read '" + recording_.file + "': at byte " + std::to_string(place_) +
                       " expected " + expected_};
  }

 private:
  bool read_ends() {
    if (!whole_.starts_with(kMagic)) return fail(whole_, "the magic bytes of an MCAP file");
    if (is_closed()) return true;
    return fail(whole_.substr(whole_.size()),
                "a footer and the magic bytes before it: the file was cut off or never closed");
  }

  bool is_closed() const {
    return whole_.size() >= 2 * kMagic.size() + internal::mcap::kFooterRecord &&
           whole_.ends_with(kMagic);
  }

  bool read_footer() {
    using internal::mcap::kFooterRecord;
    const std::size_t footer_begin = whole_.size() - kMagic.size() - kFooterRecord;
    Cursor cursor(whole_.substr(footer_begin, kFooterRecord));
    Op op{};
    std::string_view content;
    std::uint64_t offsets_begin = 0;
    if (!cursor.take_record(op, content) || op != Op::kFooter || !cursor.at_end()) {
      return fail(whole_.substr(footer_begin), "the footer");
    }
    Cursor fields(content);
    std::uint64_t summary_begin = 0;
    fields.take(summary_begin);
    fields.take(offsets_begin);
    fields.take(summary_crc_);
    const bool in_order = summary_begin >= kMagic.size() && summary_begin <= offsets_begin &&
                          offsets_begin <= footer_begin;
    if (!in_order) return fail(whole_.substr(footer_begin), "a footer with places in the file");
    summary_begin_ = static_cast<std::size_t>(summary_begin);
    summary_ = whole_.substr(summary_begin_, footer_begin - summary_begin_);
    return true;
  }

  /// The CRC is of all up to itself.
  bool check_summary() {
    const std::size_t end = whole_.size() - kMagic.size() - sizeof summary_crc_;
    return check_crc(summary_crc_, whole_.substr(summary_begin_, end - summary_begin_),
                     "the summary");
  }

  /// 0 means that the writer did not compute it.
  bool check_crc(std::uint32_t crc, std::string_view bytes, const std::string& what) {
    if (crc == 0 || crc == internal::mcap::crc32(0, bytes)) return true;
    return fail(bytes, what + " to have its CRC: the file is damaged");
  }

  bool read_data() {
    const std::string_view data = whole_.substr(0, summary_begin_);
    Cursor cursor(data.substr(kMagic.size()));
    Op op{};
    for (bool first = true; op != Op::kDataEnd; first = false) {
      const std::string_view here = cursor.rest();
      std::string_view content;
      if (!cursor.take_record(op, content)) return fail(here, "a whole record");
      if (first && op != Op::kHeader) return fail(here, "the header");
      const bool done = op == Op::kDataEnd ? check_data(here, content) : read_record(op, content);
      if (!done) return false;
    }
    return cursor.at_end() || fail(cursor.rest(), "the summary behind the end of data");
  }

  bool check_data(std::string_view data_end, std::string_view content) {
    std::uint32_t crc = 0;
    if (!Cursor(content).take(crc)) return fail(content, "the CRC of the data");
    return check_crc(crc, whole_.substr(0, place_of(data_end)), "the data before");
  }

  /// What only serves to find things is passed over, and so is what later versions may add.
  bool read_record(Op op, std::string_view content) {
    if (op == Op::kChunk) return read_chunk(content);
    if (op == Op::kChannel) return read_channel(content);
    if (op == Op::kMessage) return read_message(content);
    return true;
  }

  bool read_chunk(std::string_view content) {
    Cursor cursor(content);
    std::uint64_t begin_ns = 0;
    std::uint64_t end_ns = 0;
    std::uint64_t size = 0;
    std::uint64_t stored_size = 0;
    std::uint32_t crc = 0;
    std::string_view compression;
    std::string_view records;
    const bool whole = cursor.take(begin_ns) && cursor.take(end_ns) && cursor.take(size) &&
                       cursor.take(crc) && cursor.take_counted(compression) &&
                       cursor.take(stored_size) && cursor.take_bytes(stored_size, records);
    if (!whole) return fail(content, "a whole chunk");
    if (compression.empty()) {
      return check_crc(crc, records, "the chunk") && read_chunk_records(Cursor(records));
    }
    const auto bytes = internal::decompressed(compression, records, static_cast<std::size_t>(size));
    if (!bytes) return fail(content, "a chunk that can be read: " + bytes.error());
    within_ = content;
    const bool read =
        check_crc(crc, bytes.value(), "the chunk") && read_chunk_records(Cursor(bytes.value()));
    within_.reset();
    return read;
  }

  bool read_chunk_records(Cursor cursor) {
    while (!cursor.at_end()) {
      const std::string_view here = cursor.rest();
      Op op{};
      std::string_view content;
      if (!cursor.take_record(op, content)) return fail(here, "a whole record in the chunk");
      if (op == Op::kChunk) return fail(here, "no chunk within a chunk");
      if (!read_record(op, content)) return false;
    }
    return true;
  }

  /// The same channel may come more than once.
  bool read_channel(std::string_view content) {
    Cursor cursor(content);
    std::uint16_t id = 0;
    std::uint16_t schema = 0;
    std::string_view name;
    std::string_view encoding;
    std::string_view metadata;
    const bool whole = cursor.take(id) && cursor.take(schema) && cursor.take_counted(name) &&
                       cursor.take_counted(encoding) && cursor.take_counted(metadata);
    if (!whole) return fail(content, "a whole channel");
    const bool cdr = encoding == internal::mcap::kCdrEncoding;
    if (!cdr && encoding != internal::mcap::kMessageEncoding) {
      return fail(content, "messages in json or cdr, found '" + std::string(encoding) + "'");
    }
    RecordedChannel channel;
    channel.name = name;
    if (!read_metadata(Cursor(metadata), channel)) return false;
    if (cdr && channel.layout.empty()) {
      return fail(content,
                  "messages of armature, which tell their layout, found cdr of another "
                  "program");
    }
    const auto index = static_cast<ChannelId>(recording_.channels.size());
    const auto [known, is_new] = indexes_.emplace(id, index);
    if (is_new) {
      recording_.channels.push_back(std::move(channel));
      in_cdr_.push_back(cdr);
    } else if (recording_.channels[known->second] != channel) {
      return fail(content, "one channel for each number, found a second");
    }
    return true;
  }

  bool read_metadata(Cursor cursor, RecordedChannel& channel) {
    while (!cursor.at_end()) {
      const std::string_view here = cursor.rest();
      std::string_view key;
      std::string_view value;
      if (!cursor.take_counted(key) || !cursor.take_counted(value)) {
        return fail(here, "whole metadata");
      }
      if (key == "type") channel.type = value;
      if (key == "layout") channel.layout = value;
      if (key == "unit") channel.unit = value;
      if (key == "doc") channel.doc = value;
    }
    return true;
  }

  bool read_message(std::string_view content) {
    Cursor cursor(content);
    std::uint16_t id = 0;
    std::uint64_t time_ns = 0;
    std::uint64_t publish_time_ns = 0;
    RecordedSample sample;
    const bool whole = cursor.take(id) && cursor.take(sample.sequence) && cursor.take(time_ns) &&
                       cursor.take(publish_time_ns);
    if (!whole) return fail(content, "a whole message");
    const auto channel = indexes_.find(id);
    if (channel == indexes_.end()) return fail(content, "a message of a channel that came before");
    if (time_ns > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
      return fail(content, "a time before the year 2262");
    }
    sample.channel = channel->second;
    sample.time = base::time_from_ns(static_cast<std::int64_t>(time_ns));
    if (!read_value(sample.channel, cursor.rest(), sample.json)) return false;
    recording_.samples.push_back(std::move(sample));
    return true;
  }

  bool read_value(ChannelId channel, std::string_view content, std::string& json) {
    if (!in_cdr_[channel]) {
      json = content;
      return true;
    }
    auto read = json_of_cdr(recording_.channels[channel].layout, content);
    if (!read) return fail(content, "a value of the channel's layout: " + read.error());
    json = std::move(read).value();
    return true;
  }

  bool check_statistics() {
    Cursor cursor(summary_);
    while (!cursor.at_end()) {
      const std::string_view here = cursor.rest();
      Op op{};
      std::string_view content;
      if (!cursor.take_record(op, content)) return fail(here, "a whole record in the summary");
      if (op != Op::kStatistics) continue;
      std::uint64_t count = 0;
      const bool right = Cursor(content).take(count) && count == recording_.samples.size();
      if (!right) {
        return fail(here, "statistics of " + std::to_string(recording_.samples.size()) +
                              " messages, found " + std::to_string(count));
      }
    }
    return true;
  }

  std::size_t place_of(std::string_view part) const {
    return static_cast<std::size_t>(part.data() - whole_.data());
  }

  bool fail(std::string_view here, std::string expected) {
    place_ = place_of(within_.value_or(here));
    expected_ = std::move(expected);
    return false;
  }

  std::string_view whole_;
  std::optional<std::string_view>
      within_;                ///< the chunk, while what it was decompressed to is read
  std::vector<bool> in_cdr_;  ///< by channel
  std::string_view summary_;
  std::size_t summary_begin_ = 0;
  std::uint32_t summary_crc_ = 0;
  McapRecording recording_;
  std::unordered_map<std::uint16_t, ChannelId> indexes_;  // by the file's number
  std::size_t place_ = 0;
  std::string expected_;
};

}  // namespace

base::Result<void> McapRecording::read(const RecordedSample& sample, const types::Type& type,
                                       void* value) const {
  const RecordedChannel& channel = channels[sample.channel];
  const std::string where = "'" + file + "': channel '" + channel.name + "' ";
  if (channel.layout != types::layout_text(type)) {
    return base::Error{where + "is expected to be " + types::layout_text(type) + ", but is " +
                       channel.layout};
  }
  auto done = from_json(type, sample.json, value);
  if (done) return done;
  return base::Error{where + "at " + std::to_string(base::to_ns(sample.time)) +
                     " ns: " + done.error()};
}

base::Result<McapRecording> parse_mcap(std::string_view content, const std::string& file,
                                       Unclosed unclosed) {
  Reader reader(content, file);
  const bool done = unclosed == Unclosed::kRefused ? reader.read() : reader.read_whole_records();
  if (!done) return reader.problem();
  return reader.take_recording();
}

base::Result<McapRecording> load_mcap(const std::string& path, Unclosed unclosed) {
  const auto content = platform::read_file(path, kLargestFile);
  if (!content) return base::Error{content.error()};
  return parse_mcap(content.value(), path, unclosed);
}

}  // namespace armature::record
