// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "armature/platform/output_file.hpp"
#include "armature/record/internal/channel_list.hpp"
#include "armature/record/recording.hpp"

namespace armature::record {

/// Writes MCAP (https://mcap.dev/spec), which Foxglove and the `mcap` tools read.
///
/// Messages are JSON (json.hpp) with a JSON Schema for each type, or by the profile `ros2` CDR with
/// definitions of messages (cdr.hpp). A channel's metadata has `type` and `layout`
/// (types::layout_text), and `unit` and `doc` where there is one. Both of a message's times are the
/// sample's, on the application's clock. Chunks are indexed and have a CRC. Channels may be added
/// at any time.
class McapWriter final : public Writer {
 public:
  /// For whom the messages are.
  enum class Profile : std::uint8_t { kNone, kRos2 };
  /// How the file is written.
  struct Options {
    std::size_t chunk_size = 1u << 20;  ///< bytes of messages that are written at once
    Profile profile = Profile::kNone;
    std::string compression{};  ///< of chunks: `zstd`, `lz4`; empty: none
  };
  /// Whether this build can compress so; the error says what it lacks, or which there are.
  static base::Result<void> can_compress(const std::string& compression);

  static base::Result<std::unique_ptr<McapWriter>> create(const std::string& path,
                                                          const Options& options);
  static base::Result<std::unique_ptr<McapWriter>> create(const std::string& path) {
    return create(path, Options{});
  }
  ~McapWriter() override;

  base::Result<ChannelId> add_channel(Channel channel) override;
  /// What the whole file is about; at any time.
  base::Result<void> add_metadata(const std::string& name,
                                  const std::map<std::string, std::string>& entries);
  base::Result<void> write(const Sample& sample) override;
  base::Result<void> flush() override;
  base::Result<void> close() override;
  bool given_up() const override { return failure_.has_value(); }
  std::uint64_t unsaved() const override { return unsaved_; }

 private:
  /// Of the messages of a chunk or of the file; 0 without any.
  struct TimeSpan {
    std::uint64_t begin_ns = 0;
    std::uint64_t end_ns = 0;
    std::uint64_t message_count = 0;

    void add(std::uint64_t time_ns);
  };
  struct Chunk {
    std::string records;
    std::map<ChannelId, std::string> index;  // times and places of each channel's messages
    TimeSpan times;
  };
  struct Schema {
    std::string name;
    std::string text;
  };

  McapWriter(platform::OutputFile file, const Options& options);

  base::Result<void> begin();
  std::uint16_t schema_id(const types::Type& type);
  std::size_t most_of_chunk() const;
  bool is_for_ros() const { return options_.profile == Profile::kRos2; }
  void append_message(const Sample& sample, const types::Value& value);
  base::Result<void> write_chunk();
  std::string chunk_record(const std::string& stored) const;
  std::string message_indexes(std::uint64_t begin, std::string& offsets) const;
  std::string statistics() const;
  std::string summary(std::uint64_t begin) const;
  base::Result<void> write_end();
  base::Result<void> emit(const std::string& bytes);
  base::Result<void> check_usable() const;

  platform::OutputFile file_;
  Options options_;
  internal::ChannelList channels_;
  std::vector<Schema> schemas_;
  Chunk chunk_;

  // For the end of the file.
  std::string schema_records_;
  std::string channel_records_;
  std::string chunk_indexes_;
  std::string metadata_indexes_;
  std::uint32_t metadata_count_ = 0;
  std::uint32_t chunk_count_ = 0;
  std::vector<std::uint64_t> message_counts_;
  TimeSpan times_;

  std::uint64_t unsaved_ = 0;
  std::uint64_t size_ = 0;
  std::uint32_t crc_ = 0;
  std::optional<base::Error> failure_;
  bool closed_ = false;
};

}  // namespace armature::record
