// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>

namespace armature::base {

/// A change that mends a finding: `by` in place of `found`, which stands at the finding's place or
/// after it on the same line.
struct Replacement {
  std::string found;
  std::string by;

  friend bool operator==(const Replacement&, const Replacement&) = default;
};

/// How to mend a finding: in words and, where a tool can do it, as a change.
struct Hint {
  Hint() = default;
  // NOLINTBEGIN(google-explicit-constructor): most hints are words alone
  Hint(std::string words) : text(std::move(words)) {}
  Hint(const char* words) : text(words) {}
  // NOLINTEND(google-explicit-constructor)
  Hint(std::string words, Replacement change) : text(std::move(words)), fix(std::move(change)) {}

  bool empty() const { return text.empty(); }

  std::string text;
  std::optional<Replacement> fix;
};

}  // namespace armature::base
