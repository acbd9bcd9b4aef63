// SPDX-License-Identifier: Apache-2.0
#pragma once

// Cyclone DDS and the C types that its idlc makes of idl/ros_messages.idl.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <dds/dds.h>

#include "ros_messages.h"

namespace armature::ros2::internal {

struct DeleteQos {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using QosPtr = std::unique_ptr<dds_qos_t, DeleteQos>;

/// Lets a sequence of a message refer to `elements`, which outlive the write.
template <typename Element, typename Sequence>
void lend(std::vector<Element>& elements, Sequence& to) {
  to._length = to._maximum = static_cast<std::uint32_t>(elements.size());
  to._buffer = elements.data();
  to._release = false;
}

/// The same of a text.
inline char* lend(const std::string& text) {
  return const_cast<char*>(text.c_str());  // NOLINT: a C type without const, which is only read
}

/// Those of a sequence that came.
template <typename Sequence>
auto elements_of(const Sequence& sequence) {
  return std::vector(sequence._buffer, sequence._buffer + sequence._length);
}

}  // namespace armature::ros2::internal
