// SPDX-License-Identifier: Apache-2.0
#include "armature/base/near_name.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace armature::base {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// Edit distance in which two neighbouring letters that changed places count once.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, substitution});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) now[j] = std::min(now[j], before_last[j - 2] + 1);
    }
    std::swap(before_last, last);
    std::swap(last, now);
  }
  return last[b.size()];
}

}  // namespace

std::string near_name(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string wanted = lower(name);
  const std::size_t allowed = std::max<std::size_t>(1, wanted.size() / 3);
  std::string best;
  std::size_t best_distance = allowed + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t length_gap = candidate.size() > wanted.size()
                                       ? candidate.size() - wanted.size()
                                       : wanted.size() - candidate.size();
    if (length_gap >= best_distance) continue;
    const std::size_t d = distance(wanted, lower(candidate));
    if (d < best_distance) {
      best = candidate;
      best_distance = d;
    }
  }
  return best;
}

Hint near_hint(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string near = near_name(name, candidates);
  if (near.empty()) return {};
  return {"did you mean '" + near + "'?", {std::string(name), near}};
}

Hint suggestion(std::string_view name, const std::vector<std::string>& candidates) {
  constexpr std::size_t kMostListed = 8;
  if (Hint near = near_hint(name, candidates); !near.empty()) return near;
  if (candidates.empty() || candidates.size() > kMostListed) return {};
  std::string text = "known:";
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    text += (i == 0 ? " " : ", ") + candidates[i];
  }
  return text;
}

std::string suggestion_in_brackets(std::string_view name,
                                   const std::vector<std::string>& candidates) {
  const std::string text = suggestion(name, candidates).text;
  return text.empty() ? text : " (" + text + ")";
}

}  // namespace armature::base
