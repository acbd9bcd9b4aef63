// SPDX-License-Identifier: Apache-2.0
#include "armature/record/internal/channel_list.hpp"

#include <limits>
#include <utility>

#include "armature/base/utf8.hpp"

namespace armature::record::internal {

base::Error ChannelList::refusal(const std::string& what) const {
  return base::Error{"'" + file_ + "': " + what};
}

base::Error ChannelList::refusal(ChannelId id, const std::string& what) const {
  return refusal("channel '" + channels_[id].name + "' " + what);
}

base::Result<ChannelId> ChannelList::add(Channel channel) {
  constexpr std::size_t kMost = std::numeric_limits<ChannelId>::max();
  if (channel.name.empty()) return refusal("a channel needs a name");
  for (const std::string* text : {&channel.name, &channel.unit, &channel.doc}) {
    if (base::is_utf8(*text)) continue;
    return refusal("channel '" + channel.name +
                   "' is expected to have name, unit and documentation in UTF-8");
  }
  if (ids_.contains(channel.name)) {
    return refusal("channel '" + channel.name + "' is added already");
  }
  if (channels_.size() == kMost) {
    return refusal("at most " + std::to_string(kMost) + " channels are expected; '" + channel.name +
                   "' is one more");
  }
  const auto id = static_cast<ChannelId>(channels_.size());
  ids_.emplace(channel.name, id);
  values_.push_back(channel.shape);
  channels_.push_back(std::move(channel));
  return id;
}

base::Result<const types::Value*> ChannelList::decode(const Sample& sample) {
  const ChannelId id = sample.channel;
  if (id >= channels_.size()) {
    return refusal("a sample is expected to be of one of " + std::to_string(channels_.size()) +
                   " channels, but is of number " + std::to_string(id));
  }
  if (sample.time < base::Time{}) {
    return refusal(id, "is expected to have a time from 0 on, but has " +
                           std::to_string(base::to_ns(sample.time)) + " ns");
  }
  types::Value& value = values_[id];
  const auto used =
      types::decode(value.type(), sample.value.data(), sample.value.size(), value.data());
  if (!used) return refusal(id, "has an invalid sample: " + used.error());
  if (used.value() != sample.value.size()) {
    return refusal(id, "is expected to have samples of " + std::to_string(used.value()) +
                           " bytes, but one has " + std::to_string(sample.value.size()));
  }
  return &value;
}

}  // namespace armature::record::internal
