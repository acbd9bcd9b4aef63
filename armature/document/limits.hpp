// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace armature::document {

/// Beyond these a document is refused, so that a small file cannot fill the memory.
struct Limits {
  std::size_t file_bytes = 16u << 20;
  std::size_t nodes = 500'000;             ///< texts, lists and maps in one file
  std::size_t expanded_nodes = 5'000'000;  ///< after ranges, parameters and composites
  /// Components, composites and connections after ranges and composites; counted before they are
  /// made.
  std::size_t expanded_entries = 200'000;
  int depth = 64;  ///< of lists and maps inside each other
  int includes = 1000;
};

}  // namespace armature::document
