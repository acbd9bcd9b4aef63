// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "armature/controllers/base/controller.hpp"

namespace armature::controllers {

/// For N drives that follow positions by themselves: hands the desired positions on, and brakes
/// them as any Controller does when no reference comes.
/// @rt nonblocking, no allocation, O(joints)
class ControllerNPosition final : public Controller {
 public:
  explicit ControllerNPosition(std::string name) : Controller(std::move(name), "rad") {}

 private:
  component::Outcome on_configure() override;
  void controller_now(const std::vector<double>& measured) override;

  std::vector<double> desired_;
};

}  // namespace armature::controllers
