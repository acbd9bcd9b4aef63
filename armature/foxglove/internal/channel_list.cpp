// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/internal/channel_list.hpp"

#include <algorithm>
#include <utility>

namespace armature::foxglove::internal {
namespace {

bool is_same(const Channel& a, const Channel& b) {
  return a.advertised.topic == b.advertised.topic &&
         a.advertised.schema_name == b.advertised.schema_name &&
         a.advertised.schema == b.advertised.schema;
}

Channel channel_of(const inspect::PortDescription& port,
                   const inspect::ComponentDescription& component) {
  Channel channel;
  channel.shape = shape_of(port.type, component.fields);
  channel.kind = channel.shape.has_text() ? Channel::Kind::kTexts : Channel::Kind::kNumbers;
  const std::string doc = inspect::doc_with_values(port.doc, port.values);
  channel.advertised = {0, component.name + "." + port.name, port.type,
                        schema_of(channel.shape, about(doc, port.unit))};
  return channel;
}

}  // namespace

ChannelList::Change ChannelList::replace(std::vector<Channel> channels) {
  Change change;
  for (Channel& one : channels) {
    const auto same =
        std::ranges::find_if(channels_, [&](const Channel& known) { return is_same(known, one); });
    if (same != channels_.end()) {
      one.advertised.id = same->advertised.id;
    } else {
      one.advertised.id = ++last_;
      change.came.push_back(one.advertised);
    }
  }
  channels_.swap(channels);
  for (const Channel& before : channels) {
    if (find(before.advertised.id) == nullptr) change.gone.push_back(before.advertised.id);
  }
  return change;
}

const Channel* ChannelList::find(std::uint32_t id) const {
  const auto found =
      std::ranges::find_if(channels_, [id](const Channel& one) { return one.advertised.id == id; });
  return found == channels_.end() ? nullptr : &*found;
}

std::vector<Channel> channels_of(const inspect::ComponentDescription& component) {
  std::vector<Channel> channels;
  for (const auto& port : component.outputs) channels.push_back(channel_of(port, component));
  for (const auto& port : component.inputs) channels.push_back(channel_of(port, component));
  return channels;
}

}  // namespace armature::foxglove::internal
