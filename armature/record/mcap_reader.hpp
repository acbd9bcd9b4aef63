// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/record/recording.hpp"
#include "armature/types/type.hpp"

namespace armature::record {

/// A channel as the file has it; whoever reads its samples knows the type.
struct RecordedChannel {
  std::string name;
  std::string type;    ///< types::Type::name
  std::string layout;  ///< types::layout_text
  std::string unit;
  std::string doc;

  friend bool operator==(const RecordedChannel&, const RecordedChannel&) = default;
};

/// A sample as it was read, with its value as JSON.
struct RecordedSample {
  ChannelId channel = 0;  ///< index into the channels
  base::Time time{};
  std::uint32_t sequence = 0;
  std::string json;

  friend bool operator==(const RecordedSample&, const RecordedSample&) = default;
};

/// What McapWriter wrote; samples are in the order of writing.
struct McapRecording {
  std::string file;  ///< for errors
  std::vector<RecordedChannel> channels;
  std::vector<RecordedSample> samples;
  bool closed = true;  ///< false: it was cut off, and these are the samples of its whole chunks

  /// Reads a sample's value. An error names file and channel, and says which type was expected or
  /// where the sample is wrong; it leaves `value` as it was.
  base::Result<void> read(const RecordedSample& sample, const types::Type& type, void* value) const;
};

/// What to do with a file that was never closed, since its writer was killed or the disk was full.
enum class Unclosed : std::uint8_t {
  kRefused,
  kReadToLastChunk,  ///< all that is whole is read; also of one that was cut off later
};

/// Reads a file of McapWriter, or of another program that writes JSON with a summary. Messages in
/// CDR are read by the layout in their channel's metadata, which McapWriter writes; a channel
/// without one is refused. Every CRC is checked; a file that is damaged, or not closed unless that
/// is allowed, is refused as a whole, and the error says at which byte what was expected.
/// @param file  the name for errors
base::Result<McapRecording> parse_mcap(std::string_view content, const std::string& file,
                                       Unclosed unclosed = Unclosed::kRefused);

/// The same for a file, of which all has to fit into memory.
base::Result<McapRecording> load_mcap(const std::string& path,
                                      Unclosed unclosed = Unclosed::kRefused);

}  // namespace armature::record
