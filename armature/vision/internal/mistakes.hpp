// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/base/result.hpp"

namespace armature::vision::internal {

/// What is wrong with a configuration.
class Mistakes {
 public:
  explicit Mistakes(std::string_view object) : object_(object) {}

  /// Notes `field is VALUE, expected EXPECTED` unless it `holds`.
  void expect(bool holds, std::string_view field, double value, std::string_view expected);
  /// Above 0, at most 1.
  void expect_share(std::string_view field, double value);
  void expect_positive(std::string_view field, double value);

  /// One sentence that names all fields that are wrong.
  base::Result<void> result() const;

 private:
  std::string object_;
  std::string all_;
};

}  // namespace armature::vision::internal
