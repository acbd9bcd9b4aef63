// SPDX-License-Identifier: Apache-2.0
#include "armature/control/sampled_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>

namespace armature::control {
namespace {

/// Beyond it a pole grows; what is computed of one that rests is nearer to 1.
constexpr double kRounding = 1e-9;
/// Between two gains that are tried, and how far from 1 they go.
constexpr double kStep = 1.5;
constexpr double kFurthest = 1e4;
constexpr double kNearest = 1e-13;
/// With so small a part of its gains nothing is controlled.
constexpr double kUseless = 1e-3;

/// Of the gains, within which a loop with a margin is stable.
constexpr std::array<double, 9> kShares{0.5, 0.6, 0.71, 0.84, 1.0, 1.19, 1.41, 1.68, 2.0};

bool is_usable(const JointPlant& plant, double period_s) {
  return plant.inertia > 0.0 && plant.damping >= 0.0 && plant.delay_s >= 0.0 &&
         plant.torque_per_effort > 0.0 && period_s > 0.0;
}

struct Response {
  double angle = 0.0;
  double rate = 0.0;
};

/// Of the plant to one unit of effort for a time, from rest.
Response response(const JointPlant& plant, double time) {
  const double rate = plant.damping / plant.inertia;
  const double pull = plant.torque_per_effort / plant.inertia;
  const double turned = rate * time;
  if (turned < 1e-4) {  // The formulas below would lose all their digits.
    return {.angle = pull * time * time * (0.5 - turned / 6.0 + turned * turned / 24.0),
            .rate = pull * time * (1.0 - turned / 2.0 + turned * turned / 6.0)};
  }
  const double faded = -std::expm1(-turned) / rate;
  return {.angle = pull * (time - faded) / rate, .rate = pull * faded};
}

/// The way that a rate of 1 makes in a time without effort.
double coasted(const JointPlant& plant, double time) {
  const double turned = plant.damping / plant.inertia * time;
  if (turned < 1e-4) return time * (1.0 - turned / 2.0 + turned * turned / 6.0);
  return -std::expm1(-turned) * plant.inertia / plant.damping;
}

struct SampledPlant {
  Polynomial numerator;
  Polynomial denominator;
};

/// The angle at the samples, from efforts that are held for a period each; the one before acts
/// until the new one does.
SampledPlant sampled(const JointPlant& plant, double period_s) {
  const double cycles = std::floor(plant.delay_s / period_s);
  const double late = plant.delay_s - cycles * period_s;
  const double left = period_s - late;
  const double decay = std::exp(-plant.damping / plant.inertia * period_s);
  const double coast = coasted(plant, period_s);
  const Response now = response(plant, left);
  const Response begun = response(plant, late);
  const Response before{.angle = begun.angle + coasted(plant, left) * begun.rate,
                        .rate = begun.rate * std::exp(-plant.damping / plant.inertia * left)};
  const auto to_angle = [&](const Response& to) {
    return Polynomial{-decay * to.angle + coast * to.rate, to.angle};
  };
  const Polynomial z{0.0, 1.0};
  SampledPlant made{.numerator = to_angle(now) * z + to_angle(before),
                    .denominator = Polynomial{decay, -1.0 - decay, 1.0} * z};
  for (double cycle = 0.0; cycle < std::min(cycles, 4.0); ++cycle) {
    made.denominator = made.denominator * z;
  }
  return made;
}

struct Poles {
  double largest = 0.0;    ///< magnitude
  double frequency = 0.0;  ///< [rad/s] of that one
  double damping = 1.0;    ///< ratio of the one that is damped least
};

double damping_of(std::complex<double> pole) {
  const double decay = -std::log(std::abs(pole));
  return decay / std::hypot(decay, std::arg(pole));
}

/// Closes the loop with a share of the controller's gains.
class ClosedLoop {
 public:
  ClosedLoop(const JointPlant& plant, const SampledController& controller, double period_s)
      : period_s_(period_s) {
    const SampledPlant driven = sampled(plant, period_s);
    open_ = controller.denominator() * driven.denominator;
    fed_back_ = controller.numerator() * driven.numerator;
  }

  bool finite() const { return open_.finite() && fed_back_.finite(); }

  Poles poles(double share) const {
    const Polynomial closed = open_ + fed_back_ * share;
    Polynomial::Roots roots;
    const std::size_t count = closed.find_roots(roots);
    Poles poles;
    for (std::size_t i = 0; i < count; ++i) {
      const double magnitude = std::abs(roots[i]);
      if (magnitude > poles.largest) {
        poles.largest = magnitude;
        poles.frequency = std::abs(std::arg(roots[i])) / period_s_;
      }
      const bool swings = std::abs(roots[i].imag()) > 1e-6 && magnitude > 1e-6;
      if (swings) poles.damping = std::min(poles.damping, damping_of(roots[i]));
    }
    return poles;
  }
  bool stable(double share) const { return poles(share).largest <= 1.0 + kRounding; }

  /// Between a share that is stable and one that is not.
  double border(double good, double bad) const {
    for (int i = 0; i < 24; ++i) {
      const double between = std::sqrt(good * bad);
      (stable(between) ? good : bad) = between;
    }
    return good;
  }

 private:
  double period_s_;
  Polynomial open_;
  Polynomial fed_back_;
};

/// From 1 on, where the loop is stable, until it is not.
double margin_up(const ClosedLoop& loop) {
  for (double share = kStep; share < kFurthest; share *= kStep) {
    if (!loop.stable(share)) return loop.border(share / kStep, share);
  }
  return kFurthest;
}

/// Down to which it is stable still; 0: to nothing.
double margin_down(const ClosedLoop& loop) {
  for (double share = 1.0 / kStep; share > 1.0 / kFurthest; share /= kStep) {
    if (!loop.stable(share)) return loop.border(share * kStep, share);
  }
  return 0.0;
}

/// The largest share below 1 that is stable; 0 if none is.
double share_that_is_stable(const ClosedLoop& loop) {
  for (double share = 1.0 / kStep; share > kNearest; share /= kStep) {
    if (loop.stable(share)) return loop.border(share, share * kStep);
  }
  return 0.0;
}

}  // namespace

/// In velocity form the past output is an integral, also where nothing is integrated: there it has
/// no part in the loop.
SampledController SampledController::of(const Pid::Config& gains) {
  const Polynomial difference{-1.0, 1.0}, z{0.0, 1.0};
  if (gains.ki == 0.0) return {z * gains.kp + difference * gains.kd, z};
  return {z * difference * gains.kp + z * z * gains.ki + difference * difference * gains.kd,
          z * difference};
}

SampledController SampledController::of(const PositionalPid::Config& gains) {
  const Polynomial difference{-1.0, 1.0}, z{0.0, 1.0};
  const double kd = gains.kd / gains.period_s;
  if (gains.ki == 0.0) return {z * gains.kp + difference * kd, z};
  return {
      z * difference * gains.kp + z * (gains.ki * gains.period_s) + difference * difference * kd,
      z * difference};
}

SampledController SampledController::of(const FilteredPd& gains) {
  const double turned = gains.cutoff * gains.period_s;
  const double share = std::isinf(turned) ? 1.0 : turned / (1.0 + turned);
  const Polynomial filter{share - 1.0, 1.0}, difference{-1.0, 1.0};
  return {filter * gains.kp + difference * (gains.kd * share / gains.period_s), filter};
}

LoopStability judge_loop(const JointPlant& plant, const SampledController& controller,
                         double period_s) {
  LoopStability loop;
  if (!is_usable(plant, period_s)) return loop;
  const ClosedLoop closed(plant, controller, period_s);
  loop.finite = closed.finite();
  if (!loop.finite) return loop;
  const Poles poles = closed.poles(1.0);
  loop.largest_pole = poles.largest;
  loop.damping = poles.damping;
  if (closed.stable(1.0)) {
    loop.gain_margin = margin_up(closed);
    loop.least_gain = margin_down(closed);
  } else {
    loop.gain_margin = share_that_is_stable(closed);
  }
  const double swings_on = loop.gain_margin > 0.0 ? loop.gain_margin * 1.0001 : 1.0;
  loop.frequency = closed.poles(swings_on).frequency;
  return loop;
}

bool has_margin(const JointPlant& plant, const SampledController& controller, double period_s) {
  if (!is_usable(plant, period_s)) return false;
  const ClosedLoop closed(plant, controller, period_s);
  if (!closed.finite() || closed.poles(1.0).damping < LoopStability::kLeastDamping) return false;
  return std::ranges::all_of(kShares, [&](double share) { return closed.stable(share); });
}

std::string objection_to_loop(const LoopStability& loop) {
  if (loop.has_margin()) return {};
  if (!loop.finite) return "the gains or the robot's numbers are not finite";
  std::array<char, 256> text{};
  if (loop.gain_margin < kUseless) {
    std::snprintf(
        text.data(), text.size(),
        "unstable with any part of these gains (largest pole %.4g, expected below 1): give "
        "a smaller proportional or integral, or a larger differential gain",
        loop.largest_pole);
  } else if (loop.gain_margin < 1.0) {
    std::snprintf(
        text.data(), text.size(),
        "shakes at %.3g rad/s (largest pole %.4g, expected below 1): give at most %.3g of "
        "these gains",
        loop.frequency, loop.largest_pole, loop.gain_margin / LoopStability::kLeastMargin);
  } else if (loop.gain_margin < LoopStability::kLeastMargin) {
    std::snprintf(
        text.data(), text.size(),
        "gain margin %.3g at %.3g rad/s, expected at least %.3g: give at most %.3g of these "
        "gains",
        loop.gain_margin, loop.frequency, LoopStability::kLeastMargin,
        loop.gain_margin / LoopStability::kLeastMargin);
  } else if (loop.least_gain * LoopStability::kLeastMargin > 1.0) {
    std::snprintf(text.data(), text.size(),
                  "unstable with %.3g of these gains, expected stable down to %.3g: give a smaller "
                  "integral gain",
                  loop.least_gain, 1.0 / LoopStability::kLeastMargin);
  } else {
    std::snprintf(text.data(), text.size(),
                  "swings with a damping ratio of %.2g, expected at least %.2g: give a larger "
                  "differential gain",
                  loop.damping, LoopStability::kLeastDamping);
  }
  return text.data();
}

}  // namespace armature::control
