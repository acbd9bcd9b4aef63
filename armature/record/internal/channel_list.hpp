// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "armature/record/recording.hpp"

namespace armature::record::internal {

/// The channels of one recording, and the checks that every writer makes.
class ChannelList {
 public:
  /// @param file  for errors
  explicit ChannelList(std::string file) : file_(std::move(file)) {}

  base::Result<ChannelId> add(Channel channel);

  /// The sample's value, which the next call overwrites.
  base::Result<const types::Value*> decode(const Sample& sample);

  const Channel& operator[](ChannelId id) const { return channels_[id]; }
  std::size_t size() const { return channels_.size(); }

  /// `'file': channel 'name' what`.
  base::Error refusal(ChannelId id, const std::string& what) const;

 private:
  base::Error refusal(const std::string& what) const;

  std::string file_;
  std::vector<Channel> channels_;
  std::vector<types::Value> values_;  // of each channel, the last one decoded
  std::unordered_map<std::string, ChannelId> ids_;
};

}  // namespace armature::record::internal
