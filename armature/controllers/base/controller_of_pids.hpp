// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/control/arming/gathering.hpp"
#include "armature/controllers/base/changes.hpp"
#include "armature/controllers/base/controller.hpp"
#include "armature/controllers/base/driven_joint.hpp"
#include "armature/controllers/base/missing_answers.hpp"

namespace armature::controllers {

/// A controller that asks one PID for each joint, and perhaps others, and goes on once all have
/// answered (paper 1, section 3.3.2): to be extended by what it makes of the answers.
///
/// A round lasts from one `sensor` to the next. Who did not answer in it is counted, named, held at
/// its last value for the round after, and given up after `max_missing` rounds, as
/// control::Gathering says. Nothing is asked before the first `reference` since the start.
class ControllerOfPids : public Controller {
 public:
  using Controller::Controller;

  /// Of a PID's answer: the joint of that PID.
  std::vector<DrivenJoint> joints_behind(const component::InputPortBase* input,
                                         const component::Check& check) override;

 protected:
  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  /// Refuses PIDs that are given what is of other joints than they answer for.
  void on_check(component::Check& check) const override;
  void controller_now(const std::vector<double>& measured) final;

  /// How many answer besides the PIDs; they are the members from `joints` on.
  virtual std::size_t others() const { return 0; }
  virtual std::string_view name_of_other(std::size_t /*member*/) const { return {}; }
  /// Asks them, before the PIDs are asked.
  virtual void ask_others(const std::vector<double>& /*reference*/) {}
  /// All have answered, or are held: writes `act`.
  /// @param answers  of the PIDs first
  virtual void conclude(const std::vector<double>& answers) = 0;

  void answer(std::size_t member, double value);
  std::size_t joints() const { return static_cast<std::size_t>(joints_.get()); }

 private:
  void on_out(std::size_t joint, double out) { answer(joint, out); }
  component::Outcome set_up();
  void check_pid(const component::InputPortBase& out, const std::string& number,
                 component::Check& check) const;
  std::string_view name_of(std::size_t member);
  void note_missing();

  component::InputPorts<double> out_{this,
                                     "Out",
                                     joints_,
                                     "control signal of each PID",
                                     "",
                                     component::unit_of(out_unit_),
                                     component::on_data<&ControllerOfPids::on_out>,
                                     component::leads_to("act")};
  component::OutputPorts<double> ref_{this,    "Ref",
                                      joints_, "desired position, for each PID",
                                      "",      component::unit_of(units_.position())};
  component::OutputPorts<double> sen_{this,    "Sen",
                                      joints_, "measured position, for each PID",
                                      "",      component::unit_of(units_.position())};
  MissingAnswers missing_{this};
  Changes changes_{joints_, missing_.limit()};
  std::optional<control::Gathering> answers_;
};

}  // namespace armature::controllers
