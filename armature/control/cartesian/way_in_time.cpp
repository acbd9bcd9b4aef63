// SPDX-License-Identifier: Apache-2.0
#include "armature/control/cartesian/way_in_time.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace armature::control {
namespace {

/// At each place the least of those up to `reach` places away.
std::vector<double> least_nearby(const std::vector<double>& numbers, std::size_t reach) {
  std::vector<double> least;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t first = i - std::min(i, reach);
    const std::size_t last = std::min(numbers.size(), i + reach + 1);
    least.push_back(*std::min_element(numbers.begin() + static_cast<std::ptrdiff_t>(first),
                                      numbers.begin() + static_cast<std::ptrdiff_t>(last)));
  }
  return least;
}

}  // namespace

WayInTime::WayInTime(const WayLimits& limits)
    : length_(limits.length),
      step_(limits.length / static_cast<double>(limits.velocity.size() - 1)) {
  const double fastest = *std::ranges::max_element(limits.velocity);
  const auto reach = static_cast<std::size_t>(std::ceil(fastest * kSmoothing_s / step_)) + 1;
  speeds_ = least_nearby(limits.velocity, reach);
  const std::vector<double> hardest = least_nearby(limits.acceleration, reach);
  const auto reachable = [&](std::size_t from, std::size_t to) {
    return std::sqrt(speeds_[from] * speeds_[from] +
                     2.0 * step_ * std::min(hardest[from], hardest[to]));
  };
  const std::size_t places = speeds_.size();
  speeds_.front() = speeds_.back() = 0.0;
  for (std::size_t i = 1; i < places; ++i) speeds_[i] = std::min(speeds_[i], reachable(i - 1, i));
  for (std::size_t i = places - 1; i-- > 0;) speeds_[i] = std::min(speeds_[i], reachable(i + 1, i));
  times_.assign(places, 0.0);
  integrals_.assign(places, 0.0);
  for (std::size_t i = 0; i + 1 < places; ++i) {
    const double takes = 2.0 * step_ / (speeds_[i] + speeds_[i + 1]);
    times_[i + 1] = times_[i] + takes;
    integrals_[i + 1] = integrals_[i] + takes * (step_ * static_cast<double>(i) +
                                                 takes * (2.0 * speeds_[i] + speeds_[i + 1]) / 6.0);
  }
}

double WayInTime::at(double time_s) const {
  return (integral(time_s) - integral(time_s - kSmoothing_s)) / kSmoothing_s;
}

double WayInTime::integral(double time_s) const {
  if (time_s <= 0.0) return 0.0;
  if (time_s >= times_.back()) return integrals_.back() + length_ * (time_s - times_.back());
  const auto above = std::upper_bound(times_.begin() + 1, times_.end() - 1, time_s);
  const auto i = static_cast<std::size_t>(above - times_.begin()) - 1;
  const double since = time_s - times_[i];
  const double change = (speeds_[i + 1] - speeds_[i]) / (times_[i + 1] - times_[i]);
  return integrals_[i] + since * (step_ * static_cast<double>(i) +
                                  since * (speeds_[i] / 2.0 + since * change / 6.0));
}

}  // namespace armature::control
