// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace armature::generate::internal {

/// Lines of C++. What does not fit into 100 columns is broken at the commas of its outermost
/// brackets.
class Code {
 public:
  /// A line, or an empty one.
  void line(std::string_view text = {});
  /// A call and the calls that follow on its result, each on a line of its own:
  /// `to.component("A", "B")` and `.set("Kp", 1.0)`.
  void chain(const std::vector<std::string>& calls);
  const std::string& text() const { return text_; }

 private:
  void broken(std::string_view indent, std::string_view text);

  std::string text_;
};

}  // namespace armature::generate::internal
