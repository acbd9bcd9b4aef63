// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"

namespace armature::control::internal {

/// Collects what is wrong with the gains of a controller of several joints.
class Gains {
 public:
  Gains(std::string_view object, std::size_t joints) : object_(object), joints_(joints) {}

  /// Notes another number of gains than joints, and gains that are not finite or below 0.
  void expect(std::string_view name, const std::vector<double>& gains);
  /// Notes a part that is for another number of joints.
  void expect_joints(std::string_view name, std::size_t joints);

  /// One sentence that names all that is wrong.
  base::Result<void> result() const;

 private:
  void note(const std::string& mistake) { all_ += (all_.empty() ? "" : "; ") + mistake; }

  std::string object_;
  std::size_t joints_;
  std::string all_;
};

}  // namespace armature::control::internal
