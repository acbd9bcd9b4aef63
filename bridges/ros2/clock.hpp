// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "bridges/ros2/endpoint.hpp"

namespace armature::ros2 {

/// The simulated time, as rosgraph_msgs/Clock: for nodes with `use_sim_time`, in each of its
/// cycles. Where time is not simulated it writes nothing: nodes then have the wall clock.
class Clock final : public Publisher {
 public:
  using Publisher::Publisher;

 private:
  std::string open(const component::Surroundings& surroundings) override;
  void close() override { writer_.reset(); }
  void begin() override;
  void work() override;

  component::Property<std::string> topic_{this, "topic", "/clock", "that it writes"};
  std::unique_ptr<Writer> writer_;
};

}  // namespace armature::ros2
