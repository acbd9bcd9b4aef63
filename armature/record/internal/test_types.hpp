// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "armature/record/recording.hpp"
#include "armature/testing/test_types.hpp"

namespace armature::record {

using types::Everything;
using types::Gait;
using types::make_everything;
using types::Pose;

template <typename T>
Channel channel_of(const std::string& name, const T& shape, const std::string& unit = {},
                   const std::string& doc = {}) {
  return {name, types::Value::of(shape), unit, doc};
}

template <typename T>
base::Result<void> write(Writer& writer, ChannelId channel, std::int64_t time_ns, const T& value,
                         std::uint32_t sequence = 0) {
  std::vector<std::byte> bytes;
  types::encode(types::type_of<T>(), &value, bytes);
  return writer.write({channel, base::time_from_ns(time_ns), sequence, bytes});
}

}  // namespace armature::record
