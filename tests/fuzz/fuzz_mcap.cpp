// SPDX-License-Identifier: Apache-2.0
// parse_mcap takes or refuses any bytes, also as a file that was cut off, and what it takes refers
// only to channels that there are.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "armature/record/mcap_reader.hpp"

namespace {

void read(std::string_view content, armature::record::Unclosed unclosed) {
  using namespace armature;
  const auto recording = record::parse_mcap(content, "fuzz.mcap", unclosed);
  if (!recording) return;
  std::vector<double> value;
  for (const record::RecordedSample& sample : recording.value().samples) {
    if (sample.channel >= recording.value().channels.size()) std::abort();
    const auto& type = types::type_of<std::vector<double>>();
    const auto read = recording.value().read(sample, type, &value);
    if (!read && read.error().empty()) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  read(content, armature::record::Unclosed::kRefused);
  read(content, armature::record::Unclosed::kReadToLastChunk);
  return 0;
}
