// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/recorded_channels.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include "armature/replay/folders.hpp"

namespace armature::replay {

bool ChannelSamples::is_complete() const {
  std::uint32_t number = 0;
  return std::ranges::all_of(samples,
                             [&](const auto* sample) { return sample->sequence == ++number; });
}

std::vector<base::Time> ChannelSamples::times() const {
  std::vector<base::Time> times;
  for (const record::RecordedSample* const sample : samples) {
    if (times.empty() || sample->time > times.back()) times.push_back(sample->time);
  }
  return times;
}

RecordedChannels::RecordedChannels(const std::string& folder, const std::set<std::string>& names,
                                   base::Diagnostics& diagnostics)
    : recordings_(load_recordings(folder, names, diagnostics)) {
  base::Time begin = base::Time::max();
  for (const auto& recording : recordings_) {
    add(*recording);
    for (const record::RecordedSample& sample : recording->samples) {
      begin = std::min(begin, sample.time);
      end_ = std::max(end_, sample.time);
    }
  }
  if (begin != base::Time::max()) begin_ = begin;
}

void RecordedChannels::add(const record::McapRecording& recording) {
  std::vector<ChannelSamples> own(recording.channels.size(), {&recording});
  for (const record::RecordedSample& sample : recording.samples) {
    own[sample.channel].samples.push_back(&sample);
  }
  for (std::size_t i = 0; i < own.size(); ++i) {
    ChannelSamples& known = channels_[recording.channels[i].name];
    if (known.recording == nullptr || !known.is_complete()) known = std::move(own[i]);
  }
}

const ChannelSamples* RecordedChannels::find(const std::string& name) const {
  const auto found = channels_.find(name);
  return found == channels_.end() ? nullptr : &found->second;
}

std::vector<std::string> RecordedChannels::in_file(const std::string& name) const {
  std::vector<std::string> names;
  for (const auto& recording : recordings_) {
    if (std::filesystem::path(recording->file).filename() != name) continue;
    for (const record::RecordedChannel& channel : recording->channels) {
      names.push_back(channel.name);
    }
  }
  return names;
}

}  // namespace armature::replay
