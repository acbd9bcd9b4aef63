// SPDX-License-Identifier: Apache-2.0
#include "armature/record/mcap_writer.hpp"

#include <algorithm>
#include <utility>

#include "armature/record/cdr.hpp"
#include "armature/record/internal/compression.hpp"
#include "armature/record/internal/mcap_format.hpp"
#include "armature/record/json.hpp"

namespace armature::record {
namespace {

using internal::mcap::kMagic;
using internal::mcap::Op;
using internal::mcap::put;
using internal::mcap::put_counted;
using internal::mcap::put_record;

constexpr std::string_view kLibrary = "armature";

void put_entry(std::string_view key, std::string_view value, std::string& to) {
  put_counted(key, to);
  put_counted(value, to);
}

std::string schema_record(std::uint16_t id, const std::string& name, std::string_view encoding,
                          const std::string& text) {
  std::string content;
  put(id, content);
  put_counted(name, content);
  put_counted(encoding, content);
  put_counted(text, content);
  std::string record;
  put_record(Op::kSchema, content, record);
  return record;
}

std::string channel_record(ChannelId id, std::uint16_t schema, std::string_view encoding,
                           const Channel& channel) {
  std::string metadata;
  put_entry("type", channel.shape.type().name, metadata);
  put_entry("layout", types::layout_text(channel.shape.type()), metadata);
  if (!channel.unit.empty()) put_entry("unit", channel.unit, metadata);
  if (!channel.doc.empty()) put_entry("doc", channel.doc, metadata);
  std::string content;
  put(id, content);
  put(schema, content);
  put_counted(channel.name, content);
  put_counted(encoding, content);
  put_counted(metadata, content);
  std::string record;
  put_record(Op::kChannel, content, record);
  return record;
}

/// Appends the records of one kind to the summary, and where they are to the offsets.
void add_group(Op op, std::uint64_t summary_begin, const std::string& records, std::string& summary,
               std::string& offsets) {
  if (records.empty()) return;
  std::string content;
  put(static_cast<std::uint8_t>(op), content);
  put(summary_begin + summary.size(), content);
  put(std::uint64_t{records.size()}, content);
  put_record(Op::kSummaryOffset, content, offsets);
  summary += records;
}

}  // namespace

void McapWriter::TimeSpan::add(std::uint64_t time_ns) {
  begin_ns = message_count == 0 ? time_ns : std::min(begin_ns, time_ns);
  end_ns = std::max(end_ns, time_ns);
  ++message_count;
}

base::Result<std::unique_ptr<McapWriter>> McapWriter::create(const std::string& path,
                                                             const Options& options) {
  if (auto can = can_compress(options.compression); !can) return base::Error{can.error()};
  auto file = platform::OutputFile::create(path);
  if (!file) return base::Error{file.error()};
  std::unique_ptr<McapWriter> writer(new McapWriter(std::move(file).value(), options));
  const auto begun = writer->begin();
  if (!begun) return base::Error{begun.error()};
  return writer;
}

base::Result<void> McapWriter::can_compress(const std::string& compression) {
  return internal::can_compress(compression);
}

McapWriter::McapWriter(platform::OutputFile file, const Options& options)
    : file_(std::move(file)), options_(options), channels_(file_.path()) {}

McapWriter::~McapWriter() { static_cast<void>(McapWriter::close().ok()); }

base::Result<void> McapWriter::begin() {
  std::string bytes(kMagic);
  std::string content;
  put_counted(is_for_ros() ? internal::mcap::kRosProfile : "", content);
  put_counted(kLibrary, content);
  put_record(Op::kHeader, content, bytes);
  return emit(bytes);
}

base::Result<void> McapWriter::check_usable() const {
  if (failure_) return *failure_;
  if (closed_) return base::Error{"'" + file_.path() + "' is closed already"};
  return {};
}

base::Result<ChannelId> McapWriter::add_channel(Channel channel) {
  auto usable = check_usable();
  if (!usable) return base::Error{usable.error()};
  auto id = channels_.add(std::move(channel));
  if (!id) return id;
  const Channel& added = channels_[id.value()];
  const std::string_view encoding =
      is_for_ros() ? internal::mcap::kCdrEncoding : internal::mcap::kMessageEncoding;
  const std::string record =
      channel_record(id.value(), schema_id(added.shape.type()), encoding, added);
  channel_records_ += record;
  chunk_.records += record;
  message_counts_.push_back(0);
  return id;
}

base::Result<void> McapWriter::add_metadata(const std::string& name,
                                            const std::map<std::string, std::string>& entries) {
  auto usable = check_usable();
  if (!usable) return usable;
  std::string map;
  for (const auto& [key, value] : entries) put_entry(key, value, map);
  std::string content;
  put_counted(name, content);
  put_counted(map, content);
  std::string record;
  put_record(Op::kMetadata, content, record);
  std::string index;
  put(size_, index);
  put(std::uint64_t{record.size()}, index);
  put_counted(name, index);
  put_record(Op::kMetadataIndex, index, metadata_indexes_);
  ++metadata_count_;
  return emit(record);
}

/// Writes the schema if it is new. There are fewer than channels, so their numbers suffice.
std::uint16_t McapWriter::schema_id(const types::Type& type) {
  const std::string name = is_for_ros() ? ros2_name(type) : json_schema_name(type);
  std::string text = is_for_ros() ? ros2_definition(type) : json_schema(type);
  const auto same = [&](const Schema& schema) {
    return schema.name == name && schema.text == text;
  };
  const auto found = std::ranges::find_if(schemas_, same);
  const auto id = static_cast<std::uint16_t>(found - schemas_.begin() + 1);  // 0 means "none"
  if (found == schemas_.end()) {
    const std::string record = schema_record(
        id, name,
        is_for_ros() ? internal::mcap::kRosSchemaEncoding : internal::mcap::kSchemaEncoding, text);
    schema_records_ += record;
    chunk_.records += record;
    schemas_.push_back({name, std::move(text)});
  }
  return id;
}

base::Result<void> McapWriter::write(const Sample& sample) {
  auto usable = check_usable();
  if (!usable) return usable;
  const auto value = channels_.decode(sample);
  if (!value) return base::Error{value.error()};
  append_message(sample, *value.value());
  if (chunk_.records.size() >= most_of_chunk()) return write_chunk();
  ++unsaved_;
  return {};
}

/// The first ones are small: where a disk becomes full, or a process ends, at most a fifth of what
/// came before is lost.
std::size_t McapWriter::most_of_chunk() const {
  constexpr std::uint64_t kFirst = 4096;
  constexpr std::uint64_t kPart = 4;
  return static_cast<std::size_t>(
      std::min<std::uint64_t>(options_.chunk_size, std::max(kFirst, size_ / kPart)));
}

void McapWriter::append_message(const Sample& sample, const types::Value& value) {
  const auto time_ns = static_cast<std::uint64_t>(base::to_ns(sample.time));
  std::string& index = chunk_.index[sample.channel];
  put(time_ns, index);
  put(std::uint64_t{chunk_.records.size()}, index);

  std::string content;
  put(sample.channel, content);
  put(sample.sequence, content);
  put(time_ns, content);  // recorded
  put(time_ns, content);  // published
  content +=
      is_for_ros() ? to_cdr(value.type(), value.data()) : to_json(value.type(), value.data());
  put_record(Op::kMessage, content, chunk_.records);

  chunk_.times.add(time_ns);
  times_.add(time_ns);
  ++message_counts_[sample.channel];
}

/// @param stored  the chunk's records, perhaps compressed
std::string McapWriter::chunk_record(const std::string& stored) const {
  std::string content;
  put(chunk_.times.begin_ns, content);
  put(chunk_.times.end_ns, content);
  put(std::uint64_t{chunk_.records.size()}, content);
  put(internal::mcap::crc32(0, chunk_.records), content);
  put_counted(options_.compression, content);
  put(std::uint64_t{stored.size()}, content);
  content += stored;
  std::string record;
  put_record(Op::kChunk, content, record);
  return record;
}

/// The message index records, which begin at `begin` in the file, and where each of them is.
std::string McapWriter::message_indexes(std::uint64_t begin, std::string& offsets) const {
  std::string records;
  for (const auto& [channel, index] : chunk_.index) {
    put(channel, offsets);
    put(begin + records.size(), offsets);
    std::string content;
    put(channel, content);
    put_counted(index, content);
    put_record(Op::kMessageIndex, content, records);
  }
  return records;
}

base::Result<void> McapWriter::write_chunk() {
  if (chunk_.records.empty()) return {};
  const std::string stored = internal::compressed(options_.compression, chunk_.records);
  const std::string record = chunk_record(stored);
  std::string offsets;
  const std::string indexes = message_indexes(size_ + record.size(), offsets);
  std::string content;
  put(chunk_.times.begin_ns, content);
  put(chunk_.times.end_ns, content);
  put(size_, content);
  put(std::uint64_t{record.size()}, content);
  put_counted(offsets, content);
  put(std::uint64_t{indexes.size()}, content);
  put_counted(options_.compression, content);
  put(std::uint64_t{stored.size()}, content);
  put(std::uint64_t{chunk_.records.size()}, content);
  put_record(Op::kChunkIndex, content, chunk_indexes_);
  ++chunk_count_;
  chunk_ = {};
  auto written = emit(record + indexes);
  if (written) unsaved_ = 0;
  return written;
}

std::string McapWriter::statistics() const {
  std::string counts;
  for (std::size_t i = 0; i < message_counts_.size(); ++i) {
    put(static_cast<ChannelId>(i), counts);
    put(message_counts_[i], counts);
  }
  std::string content;
  put(times_.message_count, content);
  put(static_cast<std::uint16_t>(schemas_.size()), content);
  put(static_cast<std::uint32_t>(channels_.size()), content);
  put(std::uint32_t{0}, content);  // attachments
  put(metadata_count_, content);
  put(chunk_count_, content);
  put(times_.begin_ns, content);
  put(times_.end_ns, content);
  put_counted(counts, content);
  std::string record;
  put_record(Op::kStatistics, content, record);
  return record;
}

/// The summary, which begins at `begin` in the file, its offsets and the footer.
std::string McapWriter::summary(std::uint64_t begin) const {
  std::string bytes;
  std::string offsets;
  add_group(Op::kSchema, begin, schema_records_, bytes, offsets);
  add_group(Op::kChannel, begin, channel_records_, bytes, offsets);
  add_group(Op::kStatistics, begin, statistics(), bytes, offsets);
  add_group(Op::kChunkIndex, begin, chunk_indexes_, bytes, offsets);
  add_group(Op::kMetadataIndex, begin, metadata_indexes_, bytes, offsets);
  const std::uint64_t offsets_begin = begin + bytes.size();
  bytes += offsets;
  // The CRC is of all but itself.
  put(static_cast<std::uint8_t>(Op::kFooter), bytes);
  put(std::uint64_t{internal::mcap::kFooterContent}, bytes);
  put(begin, bytes);
  put(offsets_begin, bytes);
  put(internal::mcap::crc32(0, bytes), bytes);
  return bytes;
}

base::Result<void> McapWriter::write_end() {
  std::string content;
  put(crc_, content);
  std::string bytes;
  put_record(Op::kDataEnd, content, bytes);
  bytes += summary(size_ + bytes.size());
  bytes += kMagic;
  return emit(bytes);
}

base::Result<void> McapWriter::flush() {
  auto usable = check_usable();
  return usable ? write_chunk() : usable;
}

base::Result<void> McapWriter::close() {
  if (closed_) return {};
  if (!failure_ && write_chunk()) static_cast<void>(write_end().ok());
  closed_ = true;
  auto file_closed = file_.close();
  if (failure_) return *failure_;
  return file_closed;
}

/// After a failure nothing more is written: the file ends with its last whole record.
base::Result<void> McapWriter::emit(const std::string& bytes) {
  auto written = file_.write(bytes);
  if (!written) {
    failure_ = base::Error{written.error()};
    file_.truncate(size_);
    return written;
  }
  size_ += bytes.size();
  crc_ = internal::mcap::crc32(crc_, bytes);
  return {};
}

}  // namespace armature::record
