// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bridges/ros2/endpoint.hpp"

namespace armature::ros2 {

/// What a joystick says, as sensor_msgs/Joy. Another number of axes or buttons, an axis that is not
/// from -1 to 1, and a stamp that goes backwards are refused as a whole; behind `max_silence`
/// stamps begin anew.
class Joy final : public Subscriber {
 public:
  using Subscriber::Subscriber;

 private:
  std::string open(const component::Surroundings& surroundings) override;
  void close() override { reader_.reset(); }
  void begin() override;
  void work() override;
  std::string obey(const void* sample);

  component::Property<std::string> topic_{this, "topic", "joy", "that it reads"};
  component::Property<int> axes_{this, "axes", 2, "of the joystick", "", component::range(0, 64)};
  component::Property<int> buttons_{
      this, "buttons", 0, "of the joystick", "", component::range(0, 64)};
  component::OutputPort<std::vector<double>> axis_{this, "Axes", "of each axis, -1 to 1", "",
                                                   component::size_of(axes_)};
  component::OutputPort<std::vector<int>> button_{this, "Buttons", "of each button; 1 is pressed",
                                                  "", component::size_of(buttons_)};

  std::unique_ptr<Reader> reader_;
  std::int64_t stamp_ns_ = 0;  ///< of the last message
};

}  // namespace armature::ros2
