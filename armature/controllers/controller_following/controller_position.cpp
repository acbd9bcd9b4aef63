// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/controller_following/controller_position.hpp"

#include <algorithm>
#include <cstddef>

namespace armature::controllers {

component::Outcome ControllerNPosition::on_configure() {
  desired_.assign(static_cast<std::size_t>(joints_.get()), 0.0);
  return Controller::on_configure();
}

void ControllerNPosition::controller_now(const std::vector<double>& measured) {
  const std::vector<double>* const reference = reference_now(measured);
  if (reference == nullptr) return;
  std::copy_n(reference->begin(), desired_.size(), desired_.begin());
  drive(desired_);
}

}  // namespace armature::controllers
