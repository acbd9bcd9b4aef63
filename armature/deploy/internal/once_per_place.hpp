// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <unordered_map>

#include "armature/base/diagnostic.hpp"
#include "armature/document/value_tree.hpp"

namespace armature::deploy::internal {

using namespace document;

/// Collects what each of many passes over a text found, once for each place: a range, or a
/// composite that is used many times, meets the same mistake each time. Where only numbers differ
/// the first one says for how many others it stands.
class OncePerPlace {
 public:
  explicit OncePerPlace(base::Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// Adds what one pass found; what follows from the first `causes` at their places is left out.
  void add(const base::Diagnostics& found, std::size_t causes = 0) {
    ++pass_;
    const auto& all = found.all();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto end = all.begin() + static_cast<std::ptrdiff_t>(i < causes ? 0 : causes);
      const bool follows = std::any_of(all.begin(), end, [&](const base::Diagnostic& cause) {
        return cause.where == all[i].where;
      });
      const auto [place, is_new] = passes_.emplace(place_text(all[i].where), pass_);
      if (follows) continue;
      if (is_new || place->second == pass_) {
        diagnostics_.add(all[i]);
      } else {
        diagnostics_.add_likewise(all[i]);
      }
    }
  }

 private:
  base::Diagnostics& diagnostics_;
  std::unordered_map<std::string, int> passes_;
  int pass_ = 0;
};

}  // namespace armature::deploy::internal
