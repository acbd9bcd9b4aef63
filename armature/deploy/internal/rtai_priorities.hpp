// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "armature/base/diagnostic.hpp"
#include "armature/document/document.hpp"

namespace armature::deploy::internal {

/// The priorities of a document whose numbers are RTAI's, 1 the most urgent: the same order by
/// ours. The most urgent one becomes `kFirst`, the next one less, and so on; equal ones stay equal.
/// Other documents have our numbers already.
class RtaiPriorities {
 public:
  static constexpr int kFirst = 80;

  /// Refuses more different ones than there is room for, and threads without one: nobody is to lose
  /// real time because a 0 was read as no priority.
  RtaiPriorities(const document::Document& document, base::Diagnostics& diagnostics);

  /// @param priority  as the document has it
  int here(int priority) const;

 private:
  std::map<int, int> here_;  ///< empty if the numbers are ours
};

}  // namespace armature::deploy::internal
