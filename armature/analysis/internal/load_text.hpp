// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "armature/base/time.hpp"

namespace armature::analysis::internal {

/// `12.5 %`.
std::string percent_text(double share);

/// `2.35 ms`: four digits, for people.
std::string short_text(base::Duration duration);

/// `CPU 1`, `CPUs 0, 1`, or `2 CPUs` if they are all there are.
std::string cpus_text(const std::set<int>& cpus, const std::set<int>& all);

}  // namespace armature::analysis::internal
