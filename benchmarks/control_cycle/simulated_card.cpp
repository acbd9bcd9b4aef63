// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/control_cycle/monolithic.hpp"

namespace armature::benchmarks {

class SimulatedCard final : public HardwareCard {
 public:
  double read(bool& index) override {
    const double displacement = motor_.read();
    index = motor_.index();
    return displacement;
  }
  void drive(double voltage) override { motor_.drive(voltage); }
  const SimulatedMotor& motor() const { return motor_; }

 private:
  SimulatedMotor motor_;
};

std::vector<std::unique_ptr<HardwareCard>> make_simulated_cards(int count) {
  std::vector<std::unique_ptr<HardwareCard>> cards;
  for (int i = 0; i < count; ++i) cards.push_back(std::make_unique<SimulatedCard>());
  return cards;
}

const SimulatedMotor& motor_of(const HardwareCard& card) {
  return static_cast<const SimulatedCard&>(card).motor();
}

}  // namespace armature::benchmarks
