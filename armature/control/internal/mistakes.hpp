// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/base/result.hpp"

namespace armature::control::internal {

/// Collects what is wrong with the numbers of one configuration.
class Mistakes {
 public:
  /// @param object  what the numbers belong to, `Pid` or `Trajectory`
  explicit Mistakes(std::string_view object) : object_(object) {}

  /// Notes `field is VALUE, expected EXPECTED` unless it `holds`.
  void expect(bool holds, std::string_view field, double value, std::string_view expected);
  void expect_positive(std::string_view field, double value);
  void expect_not_negative(std::string_view field, double value);
  void expect_finite(std::string_view field, double value);
  /// Where an axis ends: numbers, which may be infinite, of the fields `lower` and `upper`.
  /// @param of  the axis, before the names of the fields
  void expect_ends(const std::string& of, double lower, double upper);

  /// One sentence that names all fields that are wrong.
  base::Result<void> result() const;

 private:
  std::string object_;
  std::string all_;
};

}  // namespace armature::control::internal
