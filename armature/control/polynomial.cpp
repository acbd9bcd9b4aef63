// SPDX-License-Identifier: Apache-2.0
#include "armature/control/polynomial.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace armature::control {

Polynomial Polynomial::operator*(const Polynomial& other) const {
  Polynomial product;
  product.size_ =
      std::min(size_ + other.size_ - (size_ > 0 && other.size_ > 0 ? 1 : 0), coefficients_.size());
  for (std::size_t i = 0; i < size_; ++i) {
    for (std::size_t j = 0; j < other.size_ && i + j < coefficients_.size(); ++j) {
      product.coefficients_[i + j] += coefficients_[i] * other.coefficients_[j];
    }
  }
  return product;
}

Polynomial Polynomial::operator*(double factor) const {
  Polynomial product = *this;
  for (double& each : product.coefficients_) each *= factor;
  return product;
}

Polynomial Polynomial::operator+(const Polynomial& other) const {
  Polynomial sum = *this;
  sum.size_ = std::max(size_, other.size_);
  for (std::size_t i = 0; i < other.size_; ++i) sum.coefficients_[i] += other.coefficients_[i];
  return sum;
}

bool Polynomial::finite() const {
  return std::ranges::all_of(coefficients_, [](double each) { return std::isfinite(each); });
}

/// By the eigenvalues of the companion matrix.
std::size_t Polynomial::find_roots(Roots& roots) const {
  constexpr int kMost = static_cast<int>(kMostDegree);
  using Companion = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMost, kMost>;
  std::size_t degree = size_ > 0 ? size_ - 1 : 0;
  while (degree > 0 && coefficients_[degree] == 0.0) --degree;
  if (degree == 0) return 0;
  const auto n = static_cast<Eigen::Index>(degree);
  Companion companion = Companion::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    companion(i, n - 1) = -coefficients_[static_cast<std::size_t>(i)] / coefficients_[degree];
    if (i > 0) companion(i, i - 1) = 1.0;
  }
  const Eigen::EigenSolver<Companion> solver(companion, false);
  for (Eigen::Index i = 0; i < n; ++i) roots[static_cast<std::size_t>(i)] = solver.eigenvalues()[i];
  return degree;
}

}  // namespace armature::control
