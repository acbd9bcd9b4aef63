// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"

namespace armature::control {

/// How well joints follow their references (paper 2, table 2): integrals over the error e(t) from
/// the first sample, t = 0, to the last, by the trapezoidal rule.
class ErrorMetrics {
 public:
  /// How many joints there are, and how often they are sampled.
  struct Config {
    std::size_t joints = 0;   ///< >= 1
    base::Duration period{};  ///< between two samples; > 0
  };

  /// Of one joint; the unit of its error is taken as rad.
  struct Figures {
    double iae = 0.0;              ///< integral of |e| [rad s]
    double itae = 0.0;             ///< integral of t |e| [rad s^2]
    double ise = 0.0;              ///< integral of e^2 [rad^2 s]
    double itse = 0.0;             ///< integral of t e^2 [rad^2 s^2]
    double largest = 0.0;          ///< the largest |e| [rad]
    double last = 0.0;             ///< e of the last sample [rad]
    std::uint64_t not_finite = 0;  ///< samples that were left out: the one before stands for them
  };

  static base::Result<void> check(const Config& config);
  static base::Result<ErrorMetrics> make(const Config& config);

  /// Adds one sample of all joints.
  /// @param errors  reference - measured, one per joint
  /// @return false, and nothing is added, if `errors` has another number of joints
  /// @rt nonblocking, no allocation, O(joints)
  /// @thread the owning activity only
  bool step(std::span<const double> errors);

  /// Back to before the first sample.
  /// @rt nonblocking, no allocation, O(joints)
  void reset();

  std::uint64_t samples() const { return samples_; }
  std::size_t joints() const { return figures_.size(); }
  const Figures& of(std::size_t joint) const { return figures_[joint]; }

 private:
  explicit ErrorMetrics(const Config& config);

  void add(Figures& figures, double error, double time_s) const;

  double period_s_;
  std::uint64_t samples_ = 0;
  std::vector<Figures> figures_;
};

}  // namespace armature::control
