// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "armature/document/document.hpp"
#include "armature/document/ranges.hpp"

namespace armature::edit::internal {

/// An end as files write it, its range or number as `{i}`: `Joint{i}` and `Position`.
struct EndText {
  std::string component;
  std::string member;
  bool shifted = false;  ///< it has a `{i+1}`

  static EndText of(const std::string& end);
  bool repeats() const;
};

/// What a composite shows of its parts to those outside, and under which names.
class Border {
 public:
  explicit Border(std::string composite) : composite_(std::move(composite)) {}

  /// Somebody outside uses `end` of a part.
  /// @param range  what `{i}` runs over, if the end repeats
  void want(document::ExportKind kind, const std::string& end,
            const std::optional<document::Range>& range);

  /// Gives short names where these are unique. Once, when all is known.
  void give_names();

  /// How those outside write the end then: `Arm.Position{1..3}`.
  std::string outside(document::ExportKind kind, const std::string& end,
                      const std::optional<document::Range>& range) const;

  /// The section `exports` of the definition.
  document::Value exports() const;

 private:
  struct Shown {
    document::ExportKind kind;
    EndText end;
    std::optional<document::Range> range;
    std::string name;
    bool covered = false;  ///< by another one, which runs over a range
  };

  static std::vector<std::string> names_of(const Shown& shown, const std::string& name);
  const Shown* find_cover(const Shown& one) const;

  std::string composite_;
  std::vector<Shown> shown_;
};

}  // namespace armature::edit::internal
