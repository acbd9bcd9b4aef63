// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/port_to_topic.hpp"

#include "armature/component/interface.hpp"
#include "armature/types/dds_idl.hpp"
#include "bridges/ros2/internal/find_port.hpp"

namespace armature::ros2 {

std::vector<PortToTopic::Objection> PortToTopic::objections(const Components& components) const {
  const auto* const port = internal::find_output(components, port_);
  if (port == nullptr) {
    return {{"unknown output '" + port_.get() + "'", "name it as Component.Port"}};
  }
  if (std::string why = types::dds_objection(port->type()); !why.empty()) {
    return {{"'" + port_.get() + "' cannot be a topic: " + why, "name another port"}};
  }
  return {};
}

std::string PortToTopic::open(const component::Surroundings& surroundings) {
  component::OutputPortBase& port = *internal::find_output(surroundings.components, port_);
  type_ = std::make_unique<internal::DescribedType>(port.type());
  value_ = std::make_unique<types::Value>(port.type());
  writer_ = writer(topic_, type_->descriptor(), {.depth = 100});
  samples_.follow(port, static_cast<std::size_t>(buffer_.get()));
  return {};
}

void PortToTopic::close() {
  samples_.end();
  writer_.reset();
  type_.reset();
  value_.reset();
}

void PortToTopic::begin() {
  Publisher::begin();
  samples_.skip();
}

void PortToTopic::work() {
  while (samples_.take_before(base::Time::max(), *value_)) {
    publish(*writer_, type_->sample_of(value_->data()));
  }
  count_lost(samples_.take_dropped());
  tell();
}

}  // namespace armature::ros2
