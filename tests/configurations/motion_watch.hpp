// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/time.hpp"

namespace armature::configurations {

/// What joints may do; what is not given is not judged.
struct Bounds {
  /// [rad/s] of the way that is made in 20 ms: who shakes makes a way, who gives a little does not.
  double speed = std::numeric_limits<double>::infinity();
  std::optional<double> moved{};  ///< [rad] from where they are now
  std::vector<double> lower{};    ///< [rad]
  std::vector<double> upper{};
};

/// Looks at where joints really are, and remembers the one that did the most of what it may not.
class MotionWatch {
 public:
  explicit MotionWatch(std::vector<double> positions) : last_(positions), from_(positions) {
    way_.resize(positions.size());
    speeds_.resize(positions.size());
  }

  void allow_from_now(Bounds bounds);
  void look_at(base::Time now, const std::vector<double>& positions);
  /// [rad/s] Of the joint that is fastest now.
  double fastest() const;
  /// `joint 2 at 0.5 rad and 0.3 rad/s, 0.02 rad from where it was`
  const std::optional<std::string>& problem() const { return problem_; }
  /// What it did, as a share of what it may, since that was allowed.
  double worst() const { return worst_; }

 private:
  void judge(std::size_t joint, double position);
  void note(double excess, std::size_t joint, double position);

  Bounds bounds_;
  std::vector<double> last_;
  std::vector<double> from_;
  std::vector<double> speeds_;
  std::vector<double> way_;
  base::Time begin_{};  ///< of the way
  base::Time last_time_{};
  std::optional<std::string> problem_;
  double worst_ = 0.0;  ///< times what is allowed, since it was allowed
};

}  // namespace armature::configurations
