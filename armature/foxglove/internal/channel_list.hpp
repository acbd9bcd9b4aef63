// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "armature/foxglove/internal/protocol.hpp"
#include "armature/foxglove/internal/shape.hpp"
#include "armature/inspect/describe.hpp"

namespace armature::foxglove::internal {

/// What a client may subscribe to: a port, or what is made of several.
struct Channel {
  /// What its values are made of.
  enum class Kind : std::uint8_t { kNumbers, kTexts, kTransforms, kScene };

  Advertised advertised;  ///< its topic is the port, `Joint1.Position`
  Kind kind = Kind::kNumbers;
  Shape shape{};  ///< of a port's values
};

/// The channels of an application, and what has changed of them.
class ChannelList {
 public:
  /// What is to be told.
  struct Change {
    std::vector<Advertised> came;
    std::vector<std::uint32_t> gone;
  };

  /// These are all that there are. Channels that stay keep their numbers.
  Change replace(std::vector<Channel> channels);

  const Channel* find(std::uint32_t id) const;
  const std::vector<Channel>& all() const { return channels_; }

 private:
  std::vector<Channel> channels_;
  std::uint32_t last_ = 0;
};

/// Of all ports of a component; without numbers yet.
std::vector<Channel> channels_of(const inspect::ComponentDescription& component);

}  // namespace armature::foxglove::internal
