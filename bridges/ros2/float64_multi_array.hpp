// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bridges/ros2/endpoint.hpp"

namespace armature::ros2 {

/// Numbers that std_msgs/Float64MultiArray brings, such as positions for `follow` of an
/// nAxesGeneratorOnline. Another number of them, one outside `lower` and `upper`, or one that is
/// not finite is refused as a whole; so is a layout that leaves some out.
class Float64MultiArray final : public Subscriber {
 public:
  using Subscriber::Subscriber;

 private:
  using Vector = std::vector<double>;

  std::vector<Objection> objections(const Components& components) const override;
  std::string open(const component::Surroundings& surroundings) override;
  void close() override { reader_.reset(); }
  void work() override;
  std::string obey(const void* sample);

  component::Property<std::string> topic_{
      this, "topic", "commands", "that it reads", "", component::mandatory};
  component::Property<int> size_{
      this, "size", 1, "how many numbers", "", component::mandatory, component::range(1, 100000)};
  component::Property<std::string> unit_{this, "unit", "", "of the numbers"};
  component::Property<Vector> lower_{this,
                                     "lower",
                                     {},
                                     "smallest of each, or of all",
                                     "",
                                     component::mandatory,
                                     component::unit_of(unit_)};
  component::Property<Vector> upper_{this,
                                     "upper",
                                     {},
                                     "largest of each, or of all",
                                     "",
                                     component::mandatory,
                                     component::unit_of(unit_)};
  component::OutputPort<Vector> data_{
      this, "Data", "the numbers", "", component::size_of(size_), component::unit_of(unit_)};

  std::unique_ptr<Reader> reader_;
};

}  // namespace armature::ros2
