// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "armature/types/type.hpp"

struct dds_topic_descriptor;

namespace armature::ros2::internal {

/// A described type as a topic of DDS: what Cyclone's idlc would make of its IDL
/// (types/dds_idl.hpp), made from the description while the program runs.
class DescribedType {
 public:
  /// @param type  to which `types::dds_objection` has none
  explicit DescribedType(const types::Type& type);
  DescribedType(const DescribedType&) = delete;
  DescribedType& operator=(const DescribedType&) = delete;
  ~DescribedType();

  const dds_topic_descriptor& descriptor() const { return *descriptor_; }
  /// The C value of a value of the type, until the next call.
  const void* sample_of(const void* value);
  /// Takes a C value, which the reader of the topic has checked, into a value of the type.
  void read(const void* sample, void* value) const;

 private:
  /// Memory of a C value and of its sequences.
  using Block = std::unique_ptr<std::byte[]>;

  void fill(const types::Type& type, const void* value, std::byte* at);

  const types::Type& type_;
  std::string name_;
  std::vector<std::uint32_t> ops_;
  std::unique_ptr<dds_topic_descriptor> descriptor_;
  std::vector<Block> blocks_;
};

}  // namespace armature::ros2::internal
