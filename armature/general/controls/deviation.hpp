// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "armature/general/controls/unit_property.hpp"

namespace armature::general {

/// A difference without its sign. What is no number is infinitely far away, so that it shows.
inline double distance(double a, double b) {
  const double difference = std::abs(a - b);
  return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
}
/// The largest one of any element; infinite for lists of different lengths.
inline double distance(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, distance(a[i], b[i]));
  return largest;
}

/// Tells how far a shadow is from the one that drives: whenever the shadow writes, its value is
/// compared with the newest one of the other. Goes on when either of them stops.
class DeviationBase : public component::Component {
 public:
  using Component::Component;

 protected:
  void tell(double difference) {
    largest_so_far_ = std::max(largest_so_far_, difference);
    difference_.write(difference);
    largest_.write(largest_so_far_);
  }

  UnitProperty unit_{this, "Unit", "of all ports"};

 private:
  component::Outcome on_start() override {
    reset();
    return component::accepted();
  }
  void reset() { largest_so_far_ = 0.0; }

  component::OutputPort<double> difference_{this, "Difference", "between the two, without sign", "",
                                            component::unit_of(unit_)};
  component::OutputPort<double> largest_{this, "Largest", "difference since the start or `reset`",
                                         "", component::unit_of(unit_)};
  component::Operation<void()> reset_{this, "reset", component::serve<&DeviationBase::reset>,
                                      "the largest difference begins anew"};
  double largest_so_far_ = 0.0;
};

/// Of numbers.
class Deviation final : public DeviationBase {
 public:
  using DeviationBase::DeviationBase;

 private:
  void compare(double shadow) {
    const auto driving = driving_.read();
    if (driving) tell(distance(driving.value, shadow));
  }
  component::InputPort<double> driving_{this,
                                        "Driving",
                                        "what drives",
                                        "",
                                        component::unit_of(unit_),
                                        component::on_lost(component::Reaction::kHold)};
  component::InputPort<double> shadow_{this,
                                       "Shadow",
                                       "what would drive",
                                       "",
                                       component::on_data<&Deviation::compare>,
                                       component::unit_of(unit_),
                                       component::on_lost(component::Reaction::kHold)};
};

/// Of lists: that of the elements which are furthest apart.
class Deviations final : public DeviationBase {
 public:
  using DeviationBase::DeviationBase;

 private:
  void compare(const std::vector<double>& shadow) {
    const auto driving = driving_.read();
    if (driving) tell(distance(driving.value, shadow));
  }
  component::Property<int> size_{this, "Size", 1, "of the lists", "", component::range(1, 1000)};
  component::InputPort<std::vector<double>> driving_{
      this,
      "Driving",
      "what drives",
      "",
      component::unit_of(unit_),
      component::size_of(size_),
      component::on_lost(component::Reaction::kHold)};
  component::InputPort<std::vector<double>> shadow_{this,
                                                    "Shadow",
                                                    "what would drive",
                                                    "",
                                                    component::on_data<&Deviations::compare>,
                                                    component::unit_of(unit_),
                                                    component::size_of(size_),
                                                    component::on_lost(component::Reaction::kHold)};
};

}  // namespace armature::general
