// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/plain.hpp"

namespace armature::benchmarks {
namespace {

double number;
std::vector<double> vector;

class PlainAdder final : public Adder {
 public:
  double add(double value) override { return sum_ += value; }

 private:
  double sum_ = 0.0;
};

}  // namespace

void plain_store(double value) { number = value; }
double plain_load() { return number; }
void plain_store(const std::vector<double>& value) { vector = value; }
const std::vector<double>& plain_load_vector() { return vector; }

std::unique_ptr<Adder> make_adder() { return std::make_unique<PlainAdder>(); }

}  // namespace armature::benchmarks
