// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/edit/internal/references.hpp"
#include "armature/edit/source_map.hpp"

namespace armature::edit::internal {

/// The name of components as a file writes it: `Sampler`, `Joint{1..3}`, `Joint{1..${joints}}`.
struct WrittenName {
  std::string begin;
  std::string braces;  ///< the range; empty: none
  std::string end;

  static WrittenName of(std::string_view text);
  std::string text() const { return begin + braces + end; }
};

/// Says which names in the files mean the components of an entry.
class EntryNames {
 public:
  /// Those of `entry`, or of `key`, which is the name of a connection.
  explicit EntryNames(const Entry& entry);
  explicit EntryNames(std::string key);

  /// What a mention writes for the components: the number or range, and the part of a composite.
  struct Meant {
    std::string number;  ///< `2`, `{i}`; empty without range
    std::string before;  ///< `Rover.` before a part of the composite Rover
    std::string behind;  ///< `.left` behind a composite
  };

  /// Nothing if `name`, written in `composite` or outside of all, means another component.
  std::optional<Meant> find(const std::string& name, const std::string& composite,
                            const SourceMap& map, const document::Document& document) const;

  /// Likewise for a key on the entry's own level.
  std::optional<Meant> find_key(const std::string& key) const;

  const WrittenName& written() const { return written_; }
  const std::string& composite() const { return composite_; }

 private:
  std::optional<Meant> find_number(std::string_view name) const;

  WrittenName written_;
  std::string composite_;
  std::vector<std::string> names_;  ///< on the entry's own level
};

}  // namespace armature::edit::internal
