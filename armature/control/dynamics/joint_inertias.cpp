// SPDX-License-Identifier: Apache-2.0
#include "armature/control/dynamics/joint_inertias.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace armature::control {
namespace {

constexpr int kSpread = 100;  ///< poses that are spread
constexpr int kLook = 9;      ///< places of a joint that is searched
constexpr int kSearches = 2;  ///< of all joints, one after the other

/// The number behind the point that mirrors `index` in a base: fills an interval evenly.
double mirrored(int index, int base) {
  double share = 1.0;
  double number = 0.0;
  for (int left = index; left > 0; left /= base) {
    share /= base;
    number += share * (left % base);
  }
  return number;
}

/// The `index`th of the first primes, and again from the first one after the last.
int prime(std::size_t index) {
  constexpr std::array<int, 12> kPrimes{2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
  return kPrimes[index % kPrimes.size()];
}

struct Quantities {
  std::vector<double> locked;
  std::vector<double> free;
  std::vector<double> weight;
};

class Search {
 public:
  Search(InverseDynamics& links, const Transmission* rotors, const std::vector<double>& lower,
         const std::vector<double>& upper)
      : links_(links), rotors_(rotors), lower_(lower), upper_(upper) {
    const std::size_t n = links.joints();
    matrix_.resize(n * n);
    for (auto* numbers : {&now_.locked, &now_.free, &now_.weight}) numbers->resize(n);
  }

  std::vector<JointRange> run() {
    const std::size_t n = links_.joints();
    std::vector<Best> most(n), least(n), weight(n);
    for (int i = 0; i < kSpread; ++i) {
      const std::vector<double> pose = spread(i);
      look(pose);
      for (std::size_t joint = 0; joint < n; ++joint) {
        most[joint].take(now_.locked[joint], pose);
        least[joint].take(-now_.free[joint], pose);
        weight[joint].take(std::abs(now_.weight[joint]), pose);
      }
    }
    std::vector<JointRange> ranges(n);
    for (std::size_t joint = 0; joint < n; ++joint) {
      climb(most[joint], [&] { return now_.locked[joint]; });
      climb(least[joint], [&] { return -now_.free[joint]; });
      climb(weight[joint], [&] { return std::abs(now_.weight[joint]); });
      ranges[joint] = {.least_inertia = -least[joint].value,
                       .most_inertia = most[joint].value,
                       .most_weight = weight[joint].value,
                       .lightest_pose = least[joint].pose,
                       .heaviest_pose = most[joint].pose};
    }
    return ranges;
  }

 private:
  struct Best {
    double value = -std::numeric_limits<double>::infinity();
    std::vector<double> pose;

    bool take(double offered, const std::vector<double>& at) {
      if (!(offered > value)) return false;
      value = offered;
      pose = at;
      return true;
    }
  };

  double place(std::size_t joint, double share) const {
    return lower_[joint] + share * (upper_[joint] - lower_[joint]);
  }
  std::vector<double> spread(int index) const {
    std::vector<double> pose(links_.joints());
    for (std::size_t i = 0; i < pose.size(); ++i) pose[i] = place(i, mirrored(index, prime(i)));
    return pose;
  }

  void look(const std::vector<double>& pose) {
    const auto n = static_cast<Eigen::Index>(links_.joints());
    links_.gravity(pose, now_.weight);
    links_.mass_matrix(pose, matrix_);
    Eigen::Map<Eigen::MatrixXd> matrix(matrix_.data(), n, n);
    for (Eigen::Index row = 0; rotors_ != nullptr && row < n; ++row) {
      for (Eigen::Index column = 0; column < n; ++column) {
        matrix(row, column) +=
            rotors_->rotor_inertia(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
      }
    }
    const Eigen::MatrixXd inverse = matrix.llt().solve(Eigen::MatrixXd::Identity(n, n));
    for (Eigen::Index i = 0; i < n; ++i) {
      now_.locked[static_cast<std::size_t>(i)] = matrix(i, i);
      now_.free[static_cast<std::size_t>(i)] = 1.0 / inverse(i, i);
    }
  }

  template <typename Value>
  void climb(Best& best, const Value& value) {
    if (best.pose.empty()) return;  // No number of it is finite.
    for (int search = 0; search < kSearches; ++search) {
      const double width = search == 0 ? 1.0 : 2.0 / (kLook - 1);
      for (std::size_t joint = 0; joint < links_.joints(); ++joint) {
        const std::vector<double> from = best.pose;
        for (int i = 0; i < kLook; ++i) {
          std::vector<double> pose = from;
          const double share = width * (static_cast<double>(i) / (kLook - 1) - 0.5);
          const double middle = search == 0 ? place(joint, 0.5) : from[joint];
          pose[joint] = std::clamp(middle + share * (upper_[joint] - lower_[joint]), lower_[joint],
                                   upper_[joint]);
          look(pose);
          best.take(value(), pose);
        }
      }
    }
  }

  InverseDynamics& links_;
  const Transmission* rotors_;
  const std::vector<double>& lower_;
  const std::vector<double>& upper_;
  std::vector<double> matrix_;
  Quantities now_;
};

}  // namespace

SearchedPoses search_limits(const InverseDynamics& links) {
  SearchedPoses poses;
  for (const JointLimits& limits : links.limits()) {
    poses.lower.push_back(std::isfinite(limits.lower) ? limits.lower : -std::numbers::pi);
    poses.upper.push_back(std::isfinite(limits.upper) ? limits.upper : std::numbers::pi);
  }
  return poses;
}

std::vector<JointRange> find_joint_ranges(InverseDynamics& links, const Transmission* rotors,
                                          const SearchedPoses& poses) {
  return Search(links, rotors, poses.lower, poses.upper).run();
}

}  // namespace armature::control
