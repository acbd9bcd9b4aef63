// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <initializer_list>

namespace armature::control {

/// A polynomial of small degree with real coefficients, as a value without memory of its own.
class Polynomial {
 public:
  static constexpr std::size_t kMostDegree = 15;
  using Roots = std::array<std::complex<double>, kMostDegree>;

  Polynomial() = default;
  /// @param coefficients  of 1, z, z^2 and so on; of the most significant one comes the degree
  Polynomial(std::initializer_list<double> coefficients) {
    for (const double each : coefficients) coefficients_[size_++] = each;
  }

  Polynomial operator*(const Polynomial& other) const;
  Polynomial operator*(double factor) const;
  Polynomial operator+(const Polynomial& other) const;
  double operator[](std::size_t power) const { return power < size_ ? coefficients_[power] : 0.0; }
  bool finite() const;

  /// @return how many of `roots` are roots; 0 for a constant
  /// @rt nonblocking, no allocation
  std::size_t find_roots(Roots& roots) const;

 private:
  std::size_t size_ = 0;
  std::array<double, kMostDegree + 1> coefficients_{};
};

}  // namespace armature::control
