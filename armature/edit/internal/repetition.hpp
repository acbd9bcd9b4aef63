// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "armature/document/ranges.hpp"
#include "armature/edit/internal/connection_items.hpp"

/// Numbers that entries and connections of files run over.
namespace armature::edit::internal {

/// Of an entry with a range: of those in one instance, if it is a part of a composite. Nothing
/// without a range, or if a parameter is part of the name beside it.
std::optional<document::Range> range_of(const Entry& entry);

/// `Joint{i}` for a key `Joint{1..3}`, empty without range.
std::string pattern_of(const Entry& entry);

/// The component of an end, `Joint{i+1}.In` or `Joint{1..3}.In`, as a pattern.
struct EndPattern {
  std::string component;  ///< `Joint{i}`
  int offset = 0;         ///< 1 of `{i+1}`
};

std::optional<EndPattern> pattern_of_end(const std::string& end);

/// What `{i}` runs over in a connection, as the reader of deployments finds it; nothing if it is a
/// single one.
std::optional<document::Range> repetition_of(const ConnectionEntry& entry, const WrittenEnds& ends,
                                             const Workshop& shop);

}  // namespace armature::edit::internal
