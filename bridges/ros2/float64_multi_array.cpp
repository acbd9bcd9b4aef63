// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/float64_multi_array.hpp"

#include "bridges/ros2/internal/dds.hpp"

namespace armature::ros2 {
namespace {

double one_of(const std::vector<double>& numbers, std::size_t i) {
  return numbers[numbers.size() == 1 ? 0 : i];
}

}  // namespace

std::vector<Float64MultiArray::Objection> Float64MultiArray::objections(
    const Components& /*components*/) const {
  std::vector<Objection> found;
  for (const auto* limits : {&lower_, &upper_}) {
    const std::size_t count = limits->get().size();
    if (count == 1 || count == static_cast<std::size_t>(size_.get())) continue;
    found.push_back({std::string(limits->name()) + " has " + std::to_string(count) +
                         " numbers, expected one or size = " + std::to_string(size_.get()),
                     "give one for each number, or one for all"});
  }
  return found;
}

std::string Float64MultiArray::open(const component::Surroundings& /*surroundings*/) {
  reader_ = reader(topic_, std_msgs_msg_dds__Float64MultiArray__desc, kCommands);
  return {};
}

void Float64MultiArray::work() {
  receive(*reader_, [this](const void* sample) { return obey(sample); });
}

std::string Float64MultiArray::obey(const void* sample) {
  const auto& array = *static_cast<const std_msgs_msg_dds__Float64MultiArray_*>(sample);
  const Vector numbers = internal::elements_of(array.data);
  if (numbers.size() != static_cast<std::size_t>(size_.get())) {
    return std::to_string(numbers.size()) + " numbers, expected " + std::to_string(size_.get());
  }
  if (array.layout.data_offset != 0) return "its layout has a data_offset, expected 0";
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double low = one_of(lower_, i);
    const double high = one_of(upper_, i);
    if (numbers[i] >= low && numbers[i] <= high) continue;
    return "number " + std::to_string(i + 1) + " is " + std::to_string(numbers[i]) + ", expected " +
           std::to_string(low) + " to " + std::to_string(high);
  }
  data_.write(numbers);
  return {};
}

}  // namespace armature::ros2
