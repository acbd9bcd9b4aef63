// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/deploy/internal/expand.hpp"
#include "armature/deploy/internal/overrides.hpp"
#include "armature/document/document.hpp"

namespace armature::deploy::internal {

using namespace document;

/// The ranges of repeated components, by the name with `{i}` in place of the range.
using RangesByPattern = std::map<std::string, std::vector<Range>>;

/// Over which numbers a connection is repeated: a range in its ends, or else the range of the
/// components that it names with `{i}`. {0, 0} without `{i}` if it is not repeated.
struct Repetition {
  Range range;
  bool repeated = false;
};
std::optional<Repetition> find_repetition(const Value& connection, const RangesByPattern& ranges,
                                          base::Diagnostics& diagnostics);

/// `connection` with the range in its ends replaced by `{i}`.
Value without_range(Value connection);

/// From the tree of a whole application, includes and all, to the Document.
Document build_document(const Value& tree, const std::string& file, std::vector<Override> overrides,
                        const Limits& limits, base::Diagnostics& diagnostics);

}  // namespace armature::deploy::internal
