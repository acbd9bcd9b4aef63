// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "armature/component/author.hpp"
#include "robots/rover/ball_path.hpp"
#include "robots/rover/numbers.hpp"
#include "robots/rover/simulated_rover.hpp"

namespace armature::rover {

ARMATURE_STRUCT(BallPoint, (x, "m", "as of Place"), (y, "m", "as of Place"),
                (z, "m", "above the floor"));

/// The ball, on a way that is chosen: for a periodic activity. With the way `ports` it is where X
/// and Y are, within the arena. `carry` takes it behind the rover's back, if Place is connected,
/// else to where the rover began.
/// @rt nonblocking, no allocation
class Ball final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_start() override;
  void on_update() override;
  void go(BallWay way);
  BallPoint behind_the_rover();

  component::Property<BallWay> way_{this, "Way", BallWay::kRest, "that it takes at the start"};
  component::Property<double> speed_{
      this, "Speed", 0.3, "with which it rolls", "m/s", component::range(0.001, 2.0)};
  component::Property<double> begin_x_{
      this, "BeginX", kBallRestX, "where it is at the start", "m", component::range(-2.9, 2.9)};
  component::Property<double> begin_y_{
      this, "BeginY", 0.0, "where it is at the start", "m", component::range(-1.9, 1.9)};
  component::InputPort<double> x_{this,
                                  "X",
                                  "where it is, on the way `ports`",
                                  "m",
                                  component::may_stay_open,
                                  component::on_lost(component::Reaction::kHold)};
  component::InputPort<double> y_{this,
                                  "Y",
                                  "where it is, on the way `ports`",
                                  "m",
                                  component::may_stay_open,
                                  component::on_lost(component::Reaction::kHold)};
  component::InputPort<Place> place_{this,
                                     "Place",
                                     "where the rover is, for `carry`",
                                     "",
                                     component::may_stay_open,
                                     component::on_lost(component::Reaction::kHold)};
  component::OutputPort<BallPoint> point_{this, "Point", "where its middle is"};
  component::Operation<void(BallWay)> go_{this,
                                          "go",
                                          component::serve<&Ball::go>,
                                          "takes another way, from where it is",
                                          component::args("way"),
                                          component::in_own_thread};

  std::optional<BallPath> path_;
  base::Time reached_{};
};

}  // namespace armature::rover
