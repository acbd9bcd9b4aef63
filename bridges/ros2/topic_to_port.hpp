// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "bridges/ros2/endpoint.hpp"
#include "bridges/ros2/internal/described_type.hpp"

namespace armature::ros2 {

/// A topic of its own for any input that may stay open and that nothing else writes. If that takes
/// vectors, it is one itself, and its component declares the size. Refused as a
/// whole is a message with a number that is not finite, a value that its enumeration does not have,
/// or a vector of another size than the input takes. `armature models --dds` prints its type.
///
/// What is older than `max_age` stops the input's component, unless that declares an age itself.
class TopicToPort final : public Subscriber {
 public:
  using Subscriber::Subscriber;

 private:
  void on_check(component::Check& check) const override;
  const component::InputPortBase* written_input(const component::Check& check) const override;
  std::vector<Objection> objections(const Components& components) const override;
  std::string open(const component::Surroundings& surroundings) override;
  void close() override;
  void work() override;
  std::string obey(const void* sample);

  component::Property<std::string> port_{
      this, "port", "", "Component.Port, an input that may stay open", "", component::mandatory};
  component::Property<std::string> topic_{
      this, "topic", "", "that it reads", "", component::mandatory};
  component::Property<double> max_age_{
      this, "max_age", 0.2, "of what came last", "s", component::range(0.001, 3600.0)};

  std::string writer_name_;
  std::unique_ptr<internal::DescribedType> type_;
  std::unique_ptr<types::Value> value_;
  std::unique_ptr<component::OutputPortBase> output_;
  std::unique_ptr<Reader> reader_;
};

}  // namespace armature::ros2
