// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

namespace armature::benchmarks {

/// What plain C++ has in place of ports, operations and events. The functions are defined
/// elsewhere, so that the compiler does not see through them.

void plain_store(double value);
double plain_load();
void plain_store(const std::vector<double>& value);
const std::vector<double>& plain_load_vector();

class Adder {
 public:
  virtual ~Adder() = default;
  /// The sum of all that was added.
  virtual double add(double value) = 0;
};
std::unique_ptr<Adder> make_adder();

}  // namespace armature::benchmarks
