// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "bridges/ros2/endpoint.hpp"
#include "bridges/ros2/internal/described_type.hpp"
#include "bridges/ros2/internal/feed.hpp"

namespace armature::ros2 {

/// Any output port as a topic of its own: one message for each sample. It is not connected to the
/// port, which is named. `armature models --dds` prints the message's type.
class PortToTopic final : public Publisher {
 public:
  using Publisher::Publisher;

 private:
  std::vector<Objection> objections(const Components& components) const override;
  std::string open(const component::Surroundings& surroundings) override;
  void close() override;
  void begin() override;
  void work() override;

  component::Property<std::string> port_{
      this, "port", "", "Component.Port, an output", "", component::mandatory};
  component::Property<std::string> topic_{
      this, "topic", "", "that it writes", "", component::mandatory};
  component::Property<int> buffer_{this, "buffer",
                                   256,  "samples that wait at most, between two updates",
                                   "",   component::range(1, 100000)};

  internal::Feed samples_;
  std::unique_ptr<internal::DescribedType> type_;
  std::unique_ptr<types::Value> value_;
  std::unique_ptr<Writer> writer_;
};

}  // namespace armature::ros2
