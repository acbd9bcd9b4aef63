// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/browser/internal/robot.hpp"
#include "armature/exec/application.hpp"

namespace armature::browser::internal {

/// The application of this process, whose names may be spelled as Lua has them.
/// @thread the controlling one
class LocalRobot final : public Robot {
 public:
  explicit LocalRobot(exec::Application& application) : application_(application) {}

  std::vector<std::string> component_names() override;
  std::string find(std::string_view text) override;
  std::string spelled(const std::string& component) const override;
  remote::ApplicationStatus status() override;
  std::vector<remote::ComponentStatus> components() override;
  remote::Faults faults() override;
  remote::ComponentDetails look_at(const std::string& component) override;
  remote::ComponentDetails interface_of(const std::string& component) override;
  std::vector<remote::ItemValue> read(const std::vector<std::string>& items,
                                      std::size_t most_elements) override;
  Changed change(const std::string& component, const std::string& change) override;

 private:
  exec::Application& application_;
};

}  // namespace armature::browser::internal
