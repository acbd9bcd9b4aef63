// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bridges/ros2/endpoint.hpp"

namespace armature::ros2 {

/// The state of every component, as diagnostic_msgs/DiagnosticArray, in each of its cycles: OK
/// while it runs, WARN while it is stopped or before, ERROR after an error or a fault, with the
/// reason. A second is a good period.
class Diagnostics final : public Publisher {
 public:
  using Publisher::Publisher;

 private:
  std::string open(const component::Surroundings& surroundings) override;
  void close() override;
  void work() override;

  component::Property<std::string> topic_{this, "topic", "/diagnostics", "that it writes"};
  component::Property<std::string> hardware_{this, "hardware_id", "", "of every status"};

  std::vector<component::Component*> components_;
  std::unique_ptr<Writer> writer_;
};

}  // namespace armature::ros2
