// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "armature/component/author.hpp"
#include "armature/controllers/base/axis_units.hpp"
#include "armature/controllers/base/max_age.hpp"

namespace armature::controllers {

/// Where an operator wants the joints (paper 3, section 6.2, Reference): write `jointPosition`,
/// then command `moveToRefOperation`, which has the generator of its peers move them there.
///
/// With each start `jointPosition` is the measured position, so that nothing moves before somebody
/// wrote to it. The command is under way as long as the generator's motion, fails with it, and
/// cancels it; what the generator refuses, it refuses or, between threads, fails with the reason.
/// It makes room for a target with the first motion: its thread is not to be that of the control.
class Reference final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_start() override;
  void on_measured(const std::vector<double>& positions);
  component::Outcome begin_move();
  void cancel() { motion_.cancel(); }
  void follow_motion();

  using Vector = std::vector<double>;
  AxisUnits units_{this, AxisUnit::Of::kAxes};
  component::Property<int> joints_{
      this, "joints", 1, "number of joints", "", component::mandatory, component::range(1, 100000)};
  component::Property<Vector> position_{this,
                                        "jointPosition",
                                        {},
                                        "where the joints are to be; at the start, where they are",
                                        "",
                                        component::changeable_while_running,
                                        component::unit_of(units_.position())};
  component::Property<double> time_{this,
                                    "moveTime",
                                    5.0,
                                    "of a motion, if that is longer than the shortest",
                                    "s",
                                    component::range(0.0, 1e6),
                                    component::changeable_while_running};
  component::InputPort<Vector> measured_{this,
                                         "nAxesSensorPosition",
                                         "measured position of each joint",
                                         "",
                                         component::on_data<&Reference::on_measured>,
                                         component::size_of(joints_),
                                         component::max_age(kMaxAge),
                                         component::leads_to_nothing(),
                                         component::unit_of(units_.position())};
  component::CommandCaller<const Vector&, double> generator_{this, "moveTo", "moves the joints"};
  component::Command<> move_{this, "moveToRefOperation", component::serve<&Reference::begin_move>,
                             "moves the joints to jointPosition, in moveTime",
                             component::cancelled_by<&Reference::cancel>};
  component::CommandHandle motion_{component::CallStatus::kNotConnected};
  bool position_known_ = false;
};

}  // namespace armature::controllers
