// SPDX-License-Identifier: Apache-2.0
#include "armature/control/taught/taught_motion.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace armature::control {
namespace {

/// Of the second differences: enough where no sample is, nothing against those that are.
constexpr double kPenalty = 0.01;
constexpr std::size_t kBand = 4;  ///< the diagonal of the equations, and three beside it
constexpr std::size_t kFewest = 4;

/// Where a time lies on the spline.
struct Place {
  std::size_t knot = 0;
  double share = 0.0;
};

Place place_of(double time_s, std::size_t points) {
  const double last = static_cast<double>(points - 3);
  const double knots = std::clamp(time_s / kKnotSpacing_s, 0.0, last);
  const double knot = std::min(std::floor(knots), last - 1.0);
  return {static_cast<std::size_t>(knot), knots - knot};
}

/// The normal equations of the fit, symmetric and banded: row i has columns i to i + 3.
class NormalEquations {
 public:
  NormalEquations(std::size_t points, std::size_t axes)
      : points_(points), axes_(axes), rows_(points), right_(points * axes, 0.0) {
    constexpr std::array<double, 3> kDifference{1.0, -2.0, 1.0};
    for (std::size_t i = 0; i + 2 < points; ++i) add(i, kDifference, kPenalty);
  }

  void add_sample(const Place& place, std::span<const double> positions) {
    const SplineWeights weights = SplineWeights::at(place.share);
    add(place.knot, weights.position, 1.0);
    for (std::size_t k = 0; k < kBand; ++k) {
      for (std::size_t axis = 0; axis < axes_; ++axis) {
        right_[(place.knot + k) * axes_ + axis] += weights.position[k] * positions[axis];
      }
    }
  }

  /// By Cholesky's decomposition: the penalty and two samples make the equations definite.
  std::vector<double> solve() && {
    decompose();
    for (std::size_t i = 0; i < points_; ++i) eliminate(i);
    for (std::size_t i = points_; i-- > 0;) substitute(i);
    return std::move(right_);
  }

 private:
  void add(std::size_t first, std::span<const double> weights, double factor) {
    for (std::size_t i = 0; i < weights.size(); ++i) {
      for (std::size_t k = i; k < weights.size(); ++k) {
        rows_[first + i][k - i] += factor * weights[i] * weights[k];
      }
    }
  }
  void decompose() {
    for (std::size_t i = 0; i < points_; ++i) {
      const double pivot = std::sqrt(rows_[i][0]);
      for (double& each : rows_[i]) each /= pivot;
      for (std::size_t k = 1; k < kBand && i + k < points_; ++k) {
        for (std::size_t m = k; m < kBand; ++m) rows_[i + k][m - k] -= rows_[i][k] * rows_[i][m];
      }
    }
  }
  void eliminate(std::size_t i) {
    for (std::size_t axis = 0; axis < axes_; ++axis) {
      const double value = right_[i * axes_ + axis] /= rows_[i][0];
      for (std::size_t k = 1; k < kBand && i + k < points_; ++k) {
        right_[(i + k) * axes_ + axis] -= rows_[i][k] * value;
      }
    }
  }
  void substitute(std::size_t i) {
    for (std::size_t axis = 0; axis < axes_; ++axis) {
      double& value = right_[i * axes_ + axis];
      for (std::size_t k = 1; k < kBand && i + k < points_; ++k) {
        value -= rows_[i][k] * right_[(i + k) * axes_ + axis];
      }
      value /= rows_[i][0];
    }
  }

  std::size_t points_;
  std::size_t axes_;
  std::vector<std::array<double, kBand>> rows_;
  std::vector<double> right_;
};

std::string mistake_in(const TaughtSamples& samples) {
  const std::size_t count = samples.times_s.size();
  if (samples.axes == 0 || samples.positions.size() != count * samples.axes) {
    return "the samples have another number of positions than of times and joints";
  }
  if (count < kFewest) {
    return "the motion has " + std::to_string(count) + " samples, expected at least " +
           std::to_string(kFewest);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto first = samples.positions.begin() + static_cast<std::ptrdiff_t>(i * samples.axes);
    const bool finite = std::all_of(first, first + static_cast<std::ptrdiff_t>(samples.axes),
                                    [](double each) { return std::isfinite(each); });
    const std::string sample = "sample " + std::to_string(i + 1);
    if (!finite || !std::isfinite(samples.times_s[i])) return sample + " has no finite number";
    if (i > 0 && !(samples.times_s[i] > samples.times_s[i - 1])) {
      return sample + " is not later than the one before it";
    }
  }
  return {};
}

double largest_deviation(const TaughtMotion& motion, const TaughtSamples& samples) {
  double largest = 0.0;
  for (std::size_t i = 0; i < samples.times_s.size(); ++i) {
    const auto there = motion.positions_at(samples.times_s[i] - samples.times_s.front());
    for (std::size_t axis = 0; axis < motion.axes; ++axis) {
      const double sample = samples.positions[i * motion.axes + axis];
      largest = std::max(largest, std::abs(there[axis] - sample));
    }
  }
  return largest;
}

}  // namespace

SplineWeights SplineWeights::at(double share) {
  const double u = share;
  const double v = 1.0 - u;
  constexpr double kOne = 1.0 / kKnotSpacing_s;
  constexpr double kTwo = kOne * kOne;
  SplineWeights weights;
  weights.position = {v * v * v / 6.0, (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
                      (3.0 * v * v * v - 6.0 * v * v + 4.0) / 6.0, u * u * u / 6.0};
  weights.slope = {-0.5 * v * v * kOne, (1.5 * u * u - 2.0 * u) * kOne,
                   (2.0 * v - 1.5 * v * v) * kOne, 0.5 * u * u * kOne};
  weights.curvature = {v * kTwo, (3.0 * u - 2.0) * kTwo, (3.0 * v - 2.0) * kTwo, u * kTwo};
  return weights;
}

std::array<double, 4> taught_hull(std::span<const double> points, std::size_t axes,
                                  std::size_t knot, std::size_t axis) {
  const auto point = [&](std::size_t k) { return points[(knot + k) * axes + axis]; };
  return {(point(0) + 4.0 * point(1) + point(2)) / 6.0, (2.0 * point(1) + point(2)) / 3.0,
          (point(1) + 2.0 * point(2)) / 3.0, (point(1) + 4.0 * point(2) + point(3)) / 6.0};
}

double TaughtMotion::duration_s() const {
  return static_cast<double>(points.size() / axes - 3) * kKnotSpacing_s;
}

std::vector<double> TaughtMotion::positions_at(double time_s) const {
  const Place place = place_of(time_s, points.size() / axes);
  const SplineWeights weights = SplineWeights::at(place.share);
  std::vector<double> positions(axes, 0.0);
  for (std::size_t k = 0; k < kBand; ++k) {
    for (std::size_t axis = 0; axis < axes; ++axis) {
      positions[axis] += weights.position[k] * points[(place.knot + k) * axes + axis];
    }
  }
  return positions;
}

base::Result<TaughtMotion> fit_taught_motion(const TaughtSamples& samples) {
  if (const std::string mistake = mistake_in(samples); !mistake.empty()) {
    return base::Error{mistake};
  }
  const double duration_s = samples.times_s.back() - samples.times_s.front();
  const auto knots = static_cast<std::size_t>(std::ceil(duration_s / kKnotSpacing_s - 1e-9));
  const std::size_t points = std::max<std::size_t>(knots, 1) + 3;
  NormalEquations equations(points, samples.axes);
  for (std::size_t i = 0; i < samples.times_s.size(); ++i) {
    equations.add_sample(place_of(samples.times_s[i] - samples.times_s.front(), points),
                         std::span(samples.positions).subspan(i * samples.axes, samples.axes));
  }
  TaughtMotion motion{samples.axes, std::move(equations).solve()};
  motion.largest_deviation = largest_deviation(motion, samples);
  return motion;
}

}  // namespace armature::control
